package limbcast.spy;

import java.io.DataInput;
import java.io.EOFException;
import java.util.TreeMap;
import lcm.lcm.LCMDataInputStream;
import lcm.logging.Log;
import lcm.spy.LCMTypeDatabase;

/** Decodes each message of a log as lcm-spy does; prints each channel, its type and how many. */
public final class ListLog {
  private ListLog() {}

  public static void main(String[] arguments) throws Exception {
    LCMTypeDatabase types = new LCMTypeDatabase();
    TreeMap<String, Integer> counts = new TreeMap<>();
    Log log = new Log(arguments[0], "r");
    try {
      while (true) {
        Log.Event event = log.readNext();
        Class<?> type =
            types.getClassByFingerprint(new LCMDataInputStream(event.data).readLong());
        LCMDataInputStream in = new LCMDataInputStream(event.data);
        type.getConstructor(DataInput.class).newInstance(in);
        if (in.available() > 0) {
          throw new IllegalStateException(event.channel + ": bytes are left over");
        }
        counts.merge(event.channel + " " + type.getName(), 1, Integer::sum);
      }
    } catch (EOFException end) {
      counts.forEach((channel, count) -> System.out.println(channel + " " + count));
    }
  }
}
