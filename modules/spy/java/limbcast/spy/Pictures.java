package limbcast.spy;

import java.awt.Point;
import java.awt.color.ColorSpace;
import java.awt.image.BufferedImage;
import java.awt.image.ColorModel;
import java.awt.image.ComponentColorModel;
import java.awt.image.DataBuffer;
import java.awt.image.DataBufferByte;
import java.awt.image.Raster;
import java.awt.image.WritableRaster;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.util.Iterator;
import javax.imageio.ImageIO;
import javax.imageio.ImageReader;
import javax.imageio.stream.ImageInputStream;
import limbcast.image_t;

/** Decodes the images of messages. Trusts none of their sizes: memory is taken after the checks. */
final class Pictures {
  /** As in the C++ decoder: larger than any camera that fits a robot. */
  private static final int MAX_SIDE = 8192;

  /** Distances at the two ends of the grey levels of a depth image, metres. */
  private static final double NEAREST = 0.5;
  private static final double FARTHEST = 8.0;

  private static final int WHITE = 255;

  private Pictures() {}

  /** Null where the message holds no image. */
  static BufferedImage decode(image_t message) throws IOException {
    if (message.width == 0 && message.height == 0) {
      return null;
    }
    require(isSide(message.width) && isSide(message.height), "the size is out of range");
    switch (message.encoding) {
      case image_t.RAW_GRAY8:
        return raw(message, ColorSpace.CS_GRAY, new int[] {0});
      case image_t.RAW_BGR8:
        return raw(message, ColorSpace.CS_sRGB, new int[] {2, 1, 0});
      case image_t.JPEG:
      case image_t.PNG:
        return file(message);
      default:
        throw new IOException("image: unknown encoding " + message.encoding);
    }
  }

  /**
   * Near is bright, black was not measured. Linear in the distance, so that people can be told from
   * the wall behind them at 4 m too.
   */
  static BufferedImage shadesOfDepth(BufferedImage depth, double metresPerUnit) throws IOException {
    require(depth.getRaster().getNumBands() == 1, "depth has more than one channel");
    BufferedImage shades =
        new BufferedImage(depth.getWidth(), depth.getHeight(), BufferedImage.TYPE_BYTE_GRAY);
    for (int y = 0; y < depth.getHeight(); ++y) {
      for (int x = 0; x < depth.getWidth(); ++x) {
        int units = depth.getRaster().getSample(x, y, 0);
        shades.getRaster().setSample(x, y, 0, shade(units * metresPerUnit));
      }
    }
    return shades;
  }

  private static int shade(double distance) {
    if (distance <= 0.0) {
      return 0;
    }
    double closeness = (FARTHEST - distance) / (FARTHEST - NEAREST);
    // The farthest is told from what was not measured.
    return (int) Math.round(Math.max(0.1, Math.min(1.0, closeness)) * WHITE);
  }

  private static BufferedImage raw(image_t message, int colorSpace, int[] bands)
      throws IOException {
    long expected = (long) message.width * message.height * bands.length;
    require(message.data.length == expected, "raw data has another size than width x height");
    WritableRaster raster =
        Raster.createInterleavedRaster(
            new DataBufferByte(message.data, message.data.length),
            message.width,
            message.height,
            message.width * bands.length,
            bands.length,
            bands,
            new Point());
    ColorModel colors =
        new ComponentColorModel(
            ColorSpace.getInstance(colorSpace),
            false,
            false,
            ColorModel.OPAQUE,
            DataBuffer.TYPE_BYTE);
    return new BufferedImage(colors, raster, false, null);
  }

  private static BufferedImage file(image_t message) throws IOException {
    try (ImageInputStream in =
        ImageIO.createImageInputStream(new ByteArrayInputStream(message.data))) {
      Iterator<ImageReader> readers = ImageIO.getImageReaders(in);
      require(readers.hasNext(), "data is neither JPEG nor PNG");
      ImageReader reader = readers.next();
      try {
        reader.setInput(in);
        require(
            reader.getWidth(0) == message.width && reader.getHeight(0) == message.height,
            "decoded size differs from width x height");
        return reader.read(0);
      } finally {
        reader.dispose();
      }
    }
  }

  private static boolean isSide(int pixels) {
    return pixels > 0 && pixels <= MAX_SIDE;
  }

  private static void require(boolean condition, String otherwise) throws IOException {
    if (!condition) {
      throw new IOException("image: " + otherwise);
    }
  }
}
