package limbcast.spy;

import static org.junit.Assert.assertEquals;
import static org.junit.Assert.assertNotEquals;

import java.awt.Color;
import java.awt.Graphics2D;
import java.awt.geom.Point2D;
import java.awt.image.BufferedImage;
import limbcast.body_pose_t;
import limbcast.body_poses_t;
import limbcast.joint_t;
import limbcast.pointing_t;
import limbcast.stamp_t;
import org.junit.Test;

public class PosesPainterTest {
  private static final int WIDTH = 900;
  private static final int HEIGHT = 300;

  /** Of a level sensor. */
  private static body_poses_t poses(joint_t... joints) {
    body_poses_t poses = new body_poses_t();
    poses.stamp = new stamp_t();
    poses.stamp.down[1] = 1.0F;
    body_pose_t person = new body_pose_t();
    for (int i = 0; i < person.joints.length; ++i) {
      person.joints[i] = i < joints.length ? joints[i] : new joint_t();
    }
    person.pointing = new pointing_t[0];
    poses.persons = new body_pose_t[] {person};
    return poses;
  }

  private static joint_t joint(String name, double x, double y, double z) {
    joint_t joint = new joint_t();
    joint.name = name;
    joint.valid = 1;
    joint.position_m = new float[] {(float) x, (float) y, (float) z};
    return joint;
  }

  private static BufferedImage painted(PosesPainter painter, body_poses_t poses) {
    BufferedImage picture = new BufferedImage(WIDTH, HEIGHT, BufferedImage.TYPE_INT_RGB);
    Graphics2D canvas = picture.createGraphics();
    painter.paint(canvas, poses, WIDTH, HEIGHT);
    canvas.dispose();
    return picture;
  }

  /**
   * The colour where a point of the world must be seen. The room that is shown at first is 4 m wide,
   * 3 m high and 5 m deep; the view's area of 284 x 264 pixels fits it by its width or depth.
   */
  private static Color seen(BufferedImage picture, Direction direction, double across, double down) {
    double[] pixelsPerMetre = {284.0 / 4.0, 284.0 / 5.0, 264.0 / 5.0};
    Point2D middle = new Point2D.Double(direction.ordinal() * 300 + 150, 28 + 264 / 2.0);
    double scale = pixelsPerMetre[direction.ordinal()];
    return new Color(
        picture.getRGB(
            (int) Math.round(middle.getX() + scale * across),
            (int) Math.round(middle.getY() + scale * down)));
  }

  @Test
  public void drawsALimbWhereItIsInEachView() {
    body_poses_t poses =
        poses(joint("elbow_left", 0.5, -0.3, 3.0), joint("wrist_left", 1.5, 0.3, 2.0));
    BufferedImage picture = painted(new PosesPainter(), poses);
    // Its middle: 1 m to the right, at the sensor's height, 2.5 m away, the middle of the room.
    assertEquals(Skeleton.LEFT, seen(picture, Direction.FRONT, 1.0, 0.0));
    assertEquals(Skeleton.LEFT, seen(picture, Direction.SIDE, 0.0, 0.0));
    assertEquals(Skeleton.LEFT, seen(picture, Direction.ABOVE, 1.0, 0.0));
    // A quarter of the way the wrist is lower, farther right and nearer.
    assertEquals(Skeleton.LEFT, seen(picture, Direction.FRONT, 1.25, 0.15));
    assertEquals(Skeleton.LEFT, seen(picture, Direction.SIDE, -0.25, 0.15));
    assertEquals(Skeleton.LEFT, seen(picture, Direction.ABOVE, 1.25, 0.25));
    // The mirrored places stay empty.
    assertNotEquals(Skeleton.LEFT, seen(picture, Direction.FRONT, -1.25, 0.15));
    assertNotEquals(Skeleton.LEFT, seen(picture, Direction.SIDE, 0.25, 0.15));
    assertNotEquals(Skeleton.LEFT, seen(picture, Direction.ABOVE, 1.25, -0.25));
  }

  @Test
  public void tellsLeftRightAndTrunkByColour() {
    body_poses_t poses =
        poses(
            joint("head", 0.0, -1.0, 2.5), joint("neck", 0.0, -0.5, 2.5),
            joint("hip_right", -1.0, 0.0, 2.5), joint("knee_right", -1.0, 0.5, 2.5));
    BufferedImage picture = painted(new PosesPainter(), poses);
    assertEquals(Skeleton.TRUNK, seen(picture, Direction.FRONT, 0.0, -0.75));
    assertEquals(Skeleton.RIGHT, seen(picture, Direction.FRONT, -1.0, 0.25));
  }

  @Test
  public void drawsNoLimbToAJointThatWasLeftOutOrIsNoPlace() {
    joint_t leftOut = joint("wrist_left", 1.5, 0.3, 2.0);
    leftOut.valid = 0;
    joint_t nowhere = joint("wrist_left", Double.NaN, 0.3, 2.0);
    for (joint_t wrist : new joint_t[] {leftOut, nowhere}) {
      BufferedImage picture =
          painted(new PosesPainter(), poses(joint("elbow_left", 0.5, -0.3, 3.0), wrist));
      assertNotEquals(Skeleton.LEFT, seen(picture, Direction.FRONT, 1.0, 0.0));
    }
  }

  @Test
  public void drawsARayFromTheWristOfTheArmThatPoints() {
    body_poses_t poses = poses(joint("wrist_right", 0.0, 0.0, 2.5));
    pointing_t arm = new pointing_t();
    arm.side = pointing_t.RIGHT;
    arm.direction = new float[] {-0.8F, 0.6F, 0.0F};
    poses.persons[0].pointing = new pointing_t[] {arm};
    BufferedImage picture = painted(new PosesPainter(), poses);
    // A thin line: smoothed, its pixels are a little darker.
    Color ray = seen(picture, Direction.FRONT, -0.8, 0.6);
    assertEquals(Skeleton.RAY.getGreen(), ray.getGreen(), 30);
    assertEquals(Skeleton.RAY.getRed(), ray.getRed(), 30);
  }

  @Test
  public void widensTheViewForPeopleBesideItButNotForNonsense() {
    PosesPainter painter = new PosesPainter();
    painted(painter, poses(joint("head", 0.0, 0.0, 1e30)));
    assertEquals(5.0, painter.room().max().forward, 0.0);
    painted(painter, poses(joint("head", 3.0, 0.0, 7.0)));
    assertEquals(7.2, painter.room().max().forward, 1e-6);
    assertEquals(3.2, painter.room().max().right, 1e-6);
    painted(painter, poses());
    assertEquals(7.2, painter.room().max().forward, 1e-6);
  }
}
