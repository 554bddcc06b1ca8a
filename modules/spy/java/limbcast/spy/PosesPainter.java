package limbcast.spy;

import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Graphics2D;
import java.awt.Rectangle;
import java.awt.RenderingHints;
import java.awt.Shape;
import java.awt.geom.Ellipse2D;
import java.awt.geom.Line2D;
import java.awt.geom.Point2D;
import java.util.Locale;
import limbcast.body_pose_t;
import limbcast.body_poses_t;
import limbcast.joint_t;

/** Draws the people of a message from the front, the side and above, over a grid of metres. */
final class PosesPainter {
  private static final Color BACKGROUND = new Color(25, 30, 35);
  private static final Color FAINT = new Color(50, 55, 60);
  private static final Color TEXT = new Color(230, 230, 230);
  private static final BasicStroke LINK_STROKE = stroke(4.0F);
  private static final BasicStroke RAY_STROKE = stroke(3.0F);
  private static final BasicStroke THIN_STROKE = stroke(1.0F);
  /** Pixels. */
  private static final double JOINT_RADIUS = 4.0;
  private static final int MARGIN = 8;
  private static final int TITLE_HEIGHT = 20;

  private final Room room = new Room();

  /** The part of a picture of that size in which a view is drawn, without its title. */
  static Rectangle area(Direction direction, int width, int height) {
    int column = width / Direction.values().length;
    return new Rectangle(
        direction.ordinal() * column + MARGIN,
        TITLE_HEIGHT + MARGIN,
        column - 2 * MARGIN,
        height - TITLE_HEIGHT - 2 * MARGIN);
  }

  Room room() {
    return room;
  }

  void paint(Graphics2D canvas, body_poses_t poses, int width, int height) {
    canvas.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
    canvas.setColor(BACKGROUND);
    canvas.fillRect(0, 0, width, height);
    LevelFrame frame = new LevelFrame(poses.stamp.down);
    for (body_pose_t person : poses.persons) {
      new Skeleton(person).joints().forEach(j -> room.include(frame.place(j.position_m)));
    }
    for (Direction direction : Direction.values()) {
      paintView(canvas, poses, frame, direction, area(direction, width, height));
    }
  }

  private void paintView(
      Graphics2D canvas,
      body_poses_t poses,
      LevelFrame frame,
      Direction direction,
      Rectangle area) {
    PixelMap map = new PixelMap(room, direction, area);
    canvas.setColor(TEXT);
    canvas.drawString(direction.title, area.x, area.y - MARGIN);
    canvas.setColor(FAINT);
    canvas.draw(area);
    Shape clip = canvas.getClip();
    canvas.clip(area);
    paintGrid(canvas, map);
    for (body_pose_t person : poses.persons) {
      paintPerson(canvas, person, frame, map);
    }
    canvas.setClip(clip);
  }

  /** A line each metre. */
  private static void paintGrid(Graphics2D canvas, PixelMap map) {
    canvas.setStroke(THIN_STROKE);
    for (double x = Math.ceil(map.left); x <= map.right; x += 1.0) {
      canvas.draw(new Line2D.Double(map.pixel(x, map.top), map.pixel(x, map.bottom)));
    }
    for (double y = Math.ceil(map.top); y <= map.bottom; y += 1.0) {
      canvas.draw(new Line2D.Double(map.pixel(map.left, y), map.pixel(map.right, y)));
    }
  }

  private static void paintPerson(
      Graphics2D canvas, body_pose_t person, LevelFrame frame, PixelMap map) {
    Skeleton skeleton = new Skeleton(person);
    for (Skeleton.Line ray : skeleton.rays()) {
      paintLine(canvas, ray, RAY_STROKE, frame, map);
    }
    for (Skeleton.Line link : skeleton.links()) {
      paintLine(canvas, link, LINK_STROKE, frame, map);
    }
    for (joint_t joint : skeleton.joints()) {
      paintJoint(canvas, joint, map.pixel(frame.place(joint.position_m)));
    }
    joint_t head = skeleton.joint("head");
    if (head != null) {
      Point2D pixel = map.pixel(frame.place(head.position_m));
      canvas.setColor(TEXT);
      canvas.drawString(
          String.format(Locale.ROOT, "%d (%.2f)", person.id, person.confidence),
          (float) (pixel.getX() + 2.0 * JOINT_RADIUS),
          (float) (pixel.getY() - 2.0 * JOINT_RADIUS));
    }
  }

  private static void paintLine(
      Graphics2D canvas, Skeleton.Line line, BasicStroke stroke, LevelFrame frame, PixelMap map) {
    canvas.setColor(line.color);
    canvas.setStroke(stroke);
    Point2D from = map.pixel(frame.place(line.from));
    Point2D to = map.pixel(frame.place(line.to));
    canvas.draw(new Line2D.Double(from, to));
  }

  /** Filled; hollow where the tracker only predicts it. */
  private static void paintJoint(Graphics2D canvas, joint_t joint, Point2D pixel) {
    Shape disc =
        new Ellipse2D.Double(
            pixel.getX() - JOINT_RADIUS,
            pixel.getY() - JOINT_RADIUS,
            2.0 * JOINT_RADIUS,
            2.0 * JOINT_RADIUS);
    canvas.setColor(joint.predicted != 0 ? BACKGROUND : TEXT);
    canvas.fill(disc);
    canvas.setColor(joint.predicted != 0 ? TEXT : BACKGROUND);
    canvas.setStroke(THIN_STROKE);
    canvas.draw(disc);
  }

  private static BasicStroke stroke(float width) {
    return new BasicStroke(width, BasicStroke.CAP_ROUND, BasicStroke.JOIN_ROUND);
  }
}
