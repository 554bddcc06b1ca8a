package limbcast.spy;

/**
 * The sensor's position, turned so that gravity points straight down and "forward" is where the
 * sensor looks along the ground. Metres.
 */
final class LevelFrame {
  /** A point seen from the sensor, in metres. */
  static final class Point {
    final double right;
    final double down;
    final double forward;

    Point(double right, double down, double forward) {
      this.right = right;
      this.down = down;
      this.forward = forward;
    }
  }

  /** Below this length a direction says nothing. */
  private static final double SHORTEST = 1e-3;

  private final double[] down;
  private final double[] forward;
  private final double[] right;

  /** {@code down}: direction of gravity in the sensor's frame (x right, y down, z forward). */
  LevelFrame(float[] down) {
    double[] level = {0.0, 1.0, 0.0};
    double[] told = {down[0], down[1], down[2]};
    double length = Math.sqrt(dot(told, told));
    this.down = Double.isFinite(length) && length > SHORTEST ? scaled(told, 1.0 / length) : level;
    forward = horizontal(this.down);
    right = cross(this.down, forward);
  }

  Point place(float[] position) {
    double[] p = {position[0], position[1], position[2]};
    return new Point(dot(p, right), dot(p, down), dot(p, forward));
  }

  private static double[] horizontal(double[] down) {
    double[] opticalAxis = {0.0, 0.0, 1.0};
    double[] along = minus(opticalAxis, scaled(down, dot(opticalAxis, down)));
    double length = Math.sqrt(dot(along, along));
    // A sensor that looks straight down: up in its image is as good as any direction.
    return length > SHORTEST ? scaled(along, 1.0 / length) : new double[] {0.0, -1.0, 0.0};
  }

  private static double dot(double[] a, double[] b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  private static double[] cross(double[] a, double[] b) {
    return new double[] {
      a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
    };
  }

  private static double[] minus(double[] a, double[] b) {
    return new double[] {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }

  private static double[] scaled(double[] a, double factor) {
    return new double[] {factor * a[0], factor * a[1], factor * a[2]};
  }
}
