package limbcast.spy;

import java.awt.AWTError;
import java.awt.GraphicsEnvironment;
import java.awt.HeadlessException;
import lcm.spy.Spy;

/** Starts lcm-spy, which ends with a stack trace where its window cannot be shown. */
public final class Start {
  private static final int WRONG_USAGE = 2;

  private Start() {}

  public static void main(String[] arguments) {
    try {
      GraphicsEnvironment.getLocalGraphicsEnvironment().getDefaultScreenDevice();
    } catch (HeadlessException | AWTError | UnsatisfiedLinkError error) {
      System.err.println(
          "limbcast-spy: there is no display for its window ("
              + reason(error)
              + "); start it on a desktop or through ssh -X,"
              + " or take limbcast-status and limbcast-viewer --png");
      System.exit(WRONG_USAGE);
    }
    Spy.main(arguments);
  }

  /** In one line; Java's own text has several. */
  private static String reason(Throwable error) {
    String display = System.getenv("DISPLAY");
    if (display == null || display.isEmpty()) {
      return "DISPLAY is not set";
    }
    return "DISPLAY is " + display + ", " + error.getMessage().strip().replaceAll("\\s+", " ");
  }
}
