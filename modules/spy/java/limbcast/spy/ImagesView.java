package limbcast.spy;

import java.awt.Color;
import java.awt.Graphics;
import java.awt.Graphics2D;
import java.awt.RenderingHints;
import java.awt.image.BufferedImage;
import java.io.IOException;
import java.util.List;
import javax.swing.Action;
import javax.swing.JComponent;
import javax.swing.JDesktopPane;
import lcm.spy.ChannelData;

/** Shows the pictures of a message beside one another, each as large as its part of the window. */
final class ImagesView<M> extends JComponent implements MessageView<M> {
  /** The pictures of a message; null for one that it does not hold. */
  interface Decoder<M> {
    List<BufferedImage> decode(M message) throws IOException;
  }

  private final Decoder<M> decoder;
  private volatile List<BufferedImage> pictures = List.of();

  /** For plugins: opens such a view of the channel. */
  static <M> Action open(
      JDesktopPane desktop,
      ChannelData channel,
      Class<M> type,
      OpenView.Decoder<M> decoder,
      Decoder<M> pictures) {
    return new OpenView<>(
        "Images", desktop, channel, type, decoder, () -> new ImagesView<>(pictures));
  }

  ImagesView(Decoder<M> decoder) {
    this.decoder = decoder;
  }

  @Override
  public JComponent component() {
    return this;
  }

  @Override
  public void show(M message) throws IOException {
    pictures = decoder.decode(message);
    repaint();
  }

  @Override
  protected void paintComponent(Graphics graphics) {
    List<BufferedImage> shown = pictures;
    Graphics2D canvas = (Graphics2D) graphics.create();
    canvas.setRenderingHint(
        RenderingHints.KEY_INTERPOLATION, RenderingHints.VALUE_INTERPOLATION_BILINEAR);
    canvas.setColor(Color.BLACK);
    canvas.fillRect(0, 0, getWidth(), getHeight());
    int column = getWidth() / Math.max(1, shown.size());
    for (int i = 0; i < shown.size(); ++i) {
      if (shown.get(i) != null) {
        draw(canvas, shown.get(i), i * column, column);
      }
    }
  }

  private void draw(Graphics2D canvas, BufferedImage picture, int left, int columnWidth) {
    double scale =
        Math.min(
            (double) columnWidth / picture.getWidth(), (double) getHeight() / picture.getHeight());
    int width = (int) Math.round(scale * picture.getWidth());
    int height = (int) Math.round(scale * picture.getHeight());
    canvas.drawImage(
        picture,
        left + (columnWidth - width) / 2,
        (getHeight() - height) / 2,
        width,
        height,
        null);
  }
}
