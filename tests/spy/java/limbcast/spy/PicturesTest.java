package limbcast.spy;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNull;
import static org.junit.Assert.assertThrows;

import java.awt.Color;
import java.awt.image.BufferedImage;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import javax.imageio.ImageIO;
import limbcast.image_t;
import org.junit.Test;

public class PicturesTest {
  private static image_t message(int width, int height, byte encoding, byte... data) {
    image_t message = new image_t();
    message.width = width;
    message.height = height;
    message.encoding = encoding;
    message.size = data.length;
    message.data = data;
    return message;
  }

  private static byte[] coded(BufferedImage image, String format) throws IOException {
    ByteArrayOutputStream bytes = new ByteArrayOutputStream();
    ImageIO.write(image, format, bytes);
    return bytes.toByteArray();
  }

  private static Color color(BufferedImage image, int x, int y) {
    return new Color(image.getRGB(x, y));
  }

  @Test
  public void showsRawBlueGreenRed() throws IOException {
    image_t message =
        message(2, 1, image_t.RAW_BGR8, (byte) 255, (byte) 0, (byte) 0, (byte) 1, (byte) 2, (byte) 3);
    BufferedImage picture = Pictures.decode(message);
    assertEquals(new Color(0, 0, 255), color(picture, 0, 0));
    assertEquals(new Color(3, 2, 1), color(picture, 1, 0));
  }

  @Test
  public void keepsTheLevelsOfRawGrey() throws IOException {
    BufferedImage picture =
        Pictures.decode(message(1, 2, image_t.RAW_GRAY8, (byte) 10, (byte) 200));
    assertEquals(10, picture.getRaster().getSample(0, 0, 0));
    assertEquals(200, picture.getRaster().getSample(0, 1, 0));
  }

  @Test
  public void decodesJpegAndPng() throws IOException {
    BufferedImage image = new BufferedImage(16, 8, BufferedImage.TYPE_INT_RGB);
    image.setRGB(3, 4, Color.GREEN.getRGB());
    BufferedImage png = Pictures.decode(message(16, 8, image_t.PNG, coded(image, "png")));
    assertEquals(Color.GREEN, color(png, 3, 4));
    BufferedImage jpeg = Pictures.decode(message(16, 8, image_t.JPEG, coded(image, "jpg")));
    assertEquals(16, jpeg.getWidth());
  }

  @Test
  public void showsNearDepthBrighterThanFarAndTheUnknownBlack() throws IOException {
    BufferedImage depth = new BufferedImage(4, 1, BufferedImage.TYPE_USHORT_GRAY);
    depth.getRaster().setSamples(0, 0, 4, 1, 0, new int[] {0, 500, 1000, 60000});
    BufferedImage decoded = Pictures.decode(message(4, 1, image_t.PNG, coded(depth, "png")));
    BufferedImage shades = Pictures.shadesOfDepth(decoded, 0.001);
    assertEquals(0, shades.getRaster().getSample(0, 0, 0));
    assertEquals(255, shades.getRaster().getSample(1, 0, 0));
    // (8 - 1) / (8 - 0.5) of 255.
    assertEquals(238, shades.getRaster().getSample(2, 0, 0));
    assertEquals(26, shades.getRaster().getSample(3, 0, 0));
  }

  @Test
  public void givesNoPictureWhereTheMessageHoldsNone() throws IOException {
    assertNull(Pictures.decode(message(0, 0, image_t.JPEG)));
  }

  @Test
  public void refusesSizesThatDoNotFitTheData() throws IOException {
    byte[] png = coded(new BufferedImage(16, 8, BufferedImage.TYPE_INT_RGB), "png");
    image_t[] wrong = {
      message(2, 2, image_t.RAW_GRAY8, (byte) 1),
      message(8, 16, image_t.PNG, png),
      message(-1, 3, image_t.RAW_GRAY8),
      message(100_000, 100_000, image_t.RAW_BGR8),
      message(16, 8, image_t.JPEG, (byte) 1, (byte) 2),
      message(1, 1, (byte) 77, (byte) 1),
    };
    for (image_t message : wrong) {
      assertThrows(IOException.class, () -> Pictures.decode(message));
    }
  }
}
