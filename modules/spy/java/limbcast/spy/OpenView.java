package limbcast.spy;

import java.awt.BorderLayout;
import java.awt.Toolkit;
import java.awt.event.ActionEvent;
import java.awt.event.HierarchyEvent;
import java.beans.PropertyVetoException;
import java.io.IOException;
import java.util.function.Supplier;
import java.util.regex.Pattern;
import javax.swing.AbstractAction;
import javax.swing.JDesktopPane;
import javax.swing.JInternalFrame;
import javax.swing.JLabel;
import javax.swing.SwingUtilities;
import lcm.lcm.LCM;
import lcm.lcm.LCMDataInputStream;
import lcm.lcm.LCMSubscriber;
import lcm.spy.ChannelData;

/**
 * Opens a view of a channel in the window that lcm-spy has made for it, and feeds it until the
 * window is closed. lcm-spy hands its plugins no messages; they come from $LCM_DEFAULT_URL, which
 * limbcast-spy sets to lcm-spy's own.
 */
final class OpenView<M> extends AbstractAction {
  /** A type's own constructor. */
  interface Decoder<M> {
    M decode(LCMDataInputStream in) throws IOException;
  }

  private final JDesktopPane desktop;
  private final ChannelData channel;
  private final Class<M> type;
  private final Decoder<M> decoder;
  private final Supplier<MessageView<M>> views;

  OpenView(
      String title,
      JDesktopPane desktop,
      ChannelData channel,
      Class<M> type,
      Decoder<M> decoder,
      Supplier<MessageView<M>> views) {
    super(title);
    this.desktop = desktop;
    this.channel = channel;
    this.type = type;
    this.decoder = decoder;
    this.views = views;
  }

  @Override
  public void actionPerformed(ActionEvent event) {
    MessageView<M> view = views.get();
    JLabel problem = new JLabel();
    fillDesktop(view, problem);
    if (type.isInstance(channel.last)) {
      show(view, problem, () -> type.cast(channel.last));
    }
    String pattern = Pattern.quote(channel.name);
    LCMSubscriber subscriber = (lcm, name, in) -> show(view, problem, () -> decoder.decode(in));
    LCM.getSingleton().subscribe(pattern, subscriber);
    desktop.addHierarchyListener(
        change -> {
          boolean showingChanged =
              (change.getChangeFlags() & HierarchyEvent.SHOWING_CHANGED) != 0;
          if (showingChanged && !desktop.isShowing()) {
            LCM.getSingleton().unsubscribe(pattern, subscriber);
          }
        });
  }

  private void fillDesktop(MessageView<M> view, JLabel problem) {
    JInternalFrame frame = new JInternalFrame((String) getValue(NAME), true, false, true);
    frame.add(view.component(), BorderLayout.CENTER);
    frame.add(problem, BorderLayout.SOUTH);
    frame.setSize(desktop.getSize());
    frame.setVisible(true);
    desktop.add(frame);
    try {
      frame.setMaximum(true);
    } catch (PropertyVetoException veto) {
      throw new IllegalStateException("nothing here vetoes", veto);
    }
  }

  /** Gives a message. */
  private interface Source<M> {
    M get() throws IOException;
  }

  /** Whoever is on the network can send: what cannot be shown is named in the window. */
  private void show(MessageView<M> view, JLabel problem, Source<M> message) {
    try {
      view.show(message.get());
      // Behind the painting in the queue: what is painted reaches the X server with the next event,
      // else, which may be the next message's.
      SwingUtilities.invokeLater(Toolkit.getDefaultToolkit()::sync);
    } catch (IOException | RuntimeException error) {
      SwingUtilities.invokeLater(() -> problem.setText("message not shown: " + error.getMessage()));
    }
  }
}
