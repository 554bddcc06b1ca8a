package limbcast.spy;

import java.awt.Graphics;
import java.awt.Graphics2D;
import javax.swing.Action;
import javax.swing.JComponent;
import javax.swing.JDesktopPane;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;
import limbcast.body_poses_t;

/** BODY_POSES, TRACKED_POSES and GROUND_TRUTH as skeletons from the front, the side and above. */
public final class PosesPlugin implements SpyPlugin {
  @Override
  public boolean canHandle(long fingerprint) {
    return fingerprint == body_poses_t.LCM_FINGERPRINT;
  }

  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return new OpenView<>(
        "Skeletons", desktop, channel, body_poses_t.class, body_poses_t::new, View::new);
  }

  private static final class View extends JComponent implements MessageView<body_poses_t> {
    private final PosesPainter painter = new PosesPainter();
    private volatile body_poses_t poses;

    @Override
    public JComponent component() {
      return this;
    }

    @Override
    public void show(body_poses_t message) {
      poses = message;
      repaint();
    }

    @Override
    protected void paintComponent(Graphics canvas) {
      if (poses != null) {
        painter.paint((Graphics2D) canvas.create(), poses, getWidth(), getHeight());
      }
    }
  }
}
