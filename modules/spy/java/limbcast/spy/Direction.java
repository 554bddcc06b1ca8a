package limbcast.spy;

/** From where people are looked at. Each view is flat: metres across and metres downwards. */
enum Direction {
  FRONT("front") {
    @Override
    double across(LevelFrame.Point point) {
      return point.right;
    }

    @Override
    double downwards(LevelFrame.Point point) {
      return point.down;
    }
  },
  /** From the right of the image; the sensor stands on the left. */
  SIDE("side, sensor on the left") {
    @Override
    double across(LevelFrame.Point point) {
      return point.forward;
    }

    @Override
    double downwards(LevelFrame.Point point) {
      return point.down;
    }
  },
  ABOVE("above, sensor at the bottom") {
    @Override
    double across(LevelFrame.Point point) {
      return point.right;
    }

    @Override
    double downwards(LevelFrame.Point point) {
      return -point.forward;
    }
  };

  final String title;

  Direction(String title) {
    this.title = title;
  }

  abstract double across(LevelFrame.Point point);

  abstract double downwards(LevelFrame.Point point);
}
