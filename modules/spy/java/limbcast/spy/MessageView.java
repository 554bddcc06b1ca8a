package limbcast.spy;

import java.io.IOException;
import javax.swing.JComponent;

/** Shows the messages of a channel in a window. */
interface MessageView<M> {
  JComponent component();

  /** Called with each message in the thread that receives; throws where the message makes no sense. */
  void show(M message) throws IOException;
}
