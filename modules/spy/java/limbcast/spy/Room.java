package limbcast.spy;

/**
 * The part of the world that is shown: grows with the people who walk into it and never shrinks, so
 * that the picture stands still. Metres.
 */
final class Room {
  /** What a usual sensor sees of people in front of it. */
  private static final LevelFrame.Point FIRST_MIN = new LevelFrame.Point(-2.0, -1.5, 0.0);
  private static final LevelFrame.Point FIRST_MAX = new LevelFrame.Point(2.0, 1.5, 5.0);
  /** No sensor finds people farther away; a nonsensical message must not shrink all others. */
  private static final double FARTHEST = 20.0;
  /** Around people. */
  private static final double MARGIN = 0.2;

  private LevelFrame.Point min = FIRST_MIN;
  private LevelFrame.Point max = FIRST_MAX;

  /** Corner with the smallest coordinates. */
  LevelFrame.Point min() {
    return min;
  }

  LevelFrame.Point max() {
    return max;
  }

  void include(LevelFrame.Point point) {
    if (!isInReach(point)) {
      return;
    }
    min =
        new LevelFrame.Point(
            Math.min(min.right, point.right - MARGIN),
            Math.min(min.down, point.down - MARGIN),
            Math.min(min.forward, point.forward - MARGIN));
    max =
        new LevelFrame.Point(
            Math.max(max.right, point.right + MARGIN),
            Math.max(max.down, point.down + MARGIN),
            Math.max(max.forward, point.forward + MARGIN));
  }

  private static boolean isInReach(LevelFrame.Point point) {
    // A comparison with NaN is false.
    return Math.abs(point.right) < FARTHEST
        && Math.abs(point.down) < FARTHEST
        && Math.abs(point.forward) < FARTHEST;
  }
}
