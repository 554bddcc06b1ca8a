package limbcast.spy;

import static org.junit.Assert.assertEquals;

import org.junit.Test;

public class LevelFrameTest {
  private static final double TOLERANCE = 1e-6; // metres, of single precision

  private static void assertPoint(
      double right, double down, double forward, LevelFrame.Point point) {
    assertEquals(right, point.right, TOLERANCE);
    assertEquals(down, point.down, TOLERANCE);
    assertEquals(forward, point.forward, TOLERANCE);
  }

  @Test
  public void keepsTheAxesOfALevelSensor() {
    LevelFrame frame = new LevelFrame(new float[] {0, 1, 0});
    assertPoint(0.5, 1.0, 3.0, frame.place(new float[] {0.5F, 1.0F, 3.0F}));
  }

  @Test
  public void turnsBackASensorThatLooksDown() {
    // Turned down by 30 degrees: gravity has a part along the optical axis.
    float sine = 0.5F;
    float cosine = (float) Math.sqrt(0.75);
    LevelFrame frame = new LevelFrame(new float[] {0, cosine, sine});
    // On the optical axis, 2 m away: 1 m below the sensor.
    assertPoint(0.0, 1.0, 2.0 * cosine, frame.place(new float[] {0, 0, 2}));
  }

  @Test
  public void showsUpInTheImageAsForwardWhereTheSensorLooksStraightDown() {
    LevelFrame frame = new LevelFrame(new float[] {0, 0, 1});
    assertPoint(0.3, 2.5, 0.4, frame.place(new float[] {0.3F, -0.4F, 2.5F}));
  }

  @Test
  public void takesTheSensorToBeLevelWhereGravityMakesNoSense() {
    for (float[] down : new float[][] {{0, 0, 0}, {Float.NaN, 1, 0}}) {
      assertPoint(1.0, 2.0, 3.0, new LevelFrame(down).place(new float[] {1, 2, 3}));
    }
  }
}
