package limbcast.spy;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertThrows;

import java.io.IOException;
import java.nio.ByteBuffer;
import lcm.lcm.LCMDataOutputStream;
import lcm.lcm.LCMEncodable;
import limbcast.image_t;
import limbcast.stamp_t;
import org.junit.Test;

/** Messages that claim more than their bytes hold end in an IOException, before memory is taken. */
public class TypesTest {
  private static final int FINGERPRINT_BYTES = 8;

  private static ByteBuffer bytesOf(LCMEncodable message) throws IOException {
    LCMDataOutputStream out = new LCMDataOutputStream();
    message.encode(out);
    return ByteBuffer.wrap(out.toByteArray());
  }

  private static ByteBuffer stampWithLength(int length) throws IOException {
    stamp_t stamp = new stamp_t();
    stamp.sensor = "front";
    stamp.frame = "left_optical";
    ByteBuffer bytes = bytesOf(stamp);
    int utimeAndSequence = 2 * Long.BYTES;
    return bytes.putInt(FINGERPRINT_BYTES + utimeAndSequence, length);
  }

  private static ByteBuffer imageWithSize(int size) throws IOException {
    image_t image = new image_t();
    image.size = 3;
    image.data = new byte[] {1, 2, 3};
    ByteBuffer bytes = bytesOf(image);
    return bytes.putInt(bytes.capacity() - image.size - Integer.BYTES, size);
  }

  @Test
  public void takeTextsAndElementsUpToTheLastByte() throws IOException {
    assertEquals("front", new stamp_t(stampWithLength("front".length() + 1).array()).sensor);
    assertEquals(3, new image_t(imageWithSize(3).array()).data[2]);
  }

  @Test
  public void refuseTextsThatAreLongerThanTheMessageOrNegative() {
    for (int length : new int[] {Integer.MAX_VALUE, 1000, 0, -1, Integer.MIN_VALUE})
      assertThrows(IOException.class, () -> new stamp_t(stampWithLength(length).array()));
  }

  @Test
  public void refuseMoreElementsThanTheMessageHoldsOrANegativeNumber() {
    for (int size : new int[] {Integer.MAX_VALUE, 4, -1, Integer.MIN_VALUE})
      assertThrows(IOException.class, () -> new image_t(imageWithSize(size).array()));
  }
}
