package limbcast.spy;

import java.awt.Rectangle;
import java.awt.geom.Point2D;

/** Where the points of a room come to stand on the screen: all of it, in the middle, undistorted. */
final class PixelMap {
  // What is shown, metres in the view.
  final double left;
  final double right;
  final double top;
  final double bottom;

  private final Direction direction;
  private final double pixelsPerMetre;
  private final double x0;
  private final double y0;

  PixelMap(Room room, Direction direction, Rectangle area) {
    this.direction = direction;
    left = Math.min(direction.across(room.min()), direction.across(room.max()));
    right = Math.max(direction.across(room.min()), direction.across(room.max()));
    top = Math.min(direction.downwards(room.min()), direction.downwards(room.max()));
    bottom = Math.max(direction.downwards(room.min()), direction.downwards(room.max()));
    pixelsPerMetre = Math.min(area.width / (right - left), area.height / (bottom - top));
    x0 = area.getCenterX() - pixelsPerMetre * (left + right) / 2.0;
    y0 = area.getCenterY() - pixelsPerMetre * (top + bottom) / 2.0;
  }

  Point2D pixel(LevelFrame.Point point) {
    return pixel(direction.across(point), direction.downwards(point));
  }

  Point2D pixel(double across, double downwards) {
    return new Point2D.Double(x0 + pixelsPerMetre * across, y0 + pixelsPerMetre * downwards);
  }
}
