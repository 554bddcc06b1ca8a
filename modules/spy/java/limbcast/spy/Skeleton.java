package limbcast.spy;

import java.awt.Color;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import limbcast.body_pose_t;
import limbcast.joint_t;
import limbcast.pointing_t;

/** What is to be drawn of one person: lines between joints, the joints, and rays of arms that point. */
final class Skeleton {
  /** In the sensor's frame, metres. */
  static final class Line {
    final float[] from;
    final float[] to;
    final Color color;

    Line(float[] from, float[] to, Color color) {
      this.from = from;
      this.to = to;
      this.color = color;
    }
  }

  // The colours of limbcast-viewer.
  static final Color LEFT = new Color(40, 170, 255);
  static final Color RIGHT = new Color(255, 120, 20);
  static final Color TRUNK = new Color(250, 230, 40);
  static final Color RAY = new Color(80, 255, 80);

  /** The 15 links of the paper's Table I, by the names of their joints. */
  private static final String[][] LINKS = {
    {"head", "neck"}, {"neck", "chest"}, {"chest", "pelvis"},
    {"neck", "shoulder_left"}, {"shoulder_left", "elbow_left"}, {"elbow_left", "wrist_left"},
    {"neck", "shoulder_right"}, {"shoulder_right", "elbow_right"}, {"elbow_right", "wrist_right"},
    {"pelvis", "hip_left"}, {"hip_left", "knee_left"}, {"knee_left", "ankle_left"},
    {"pelvis", "hip_right"}, {"hip_right", "knee_right"}, {"knee_right", "ankle_right"},
  };

  /** How far a ray goes beyond the wrist, metres. */
  private static final float RAY_LENGTH = 1.5F;

  private final body_pose_t person;

  Skeleton(body_pose_t person) {
    this.person = person;
  }

  List<Line> links() {
    List<Line> lines = new ArrayList<>();
    for (String[] link : LINKS) {
      joint_t from = joint(link[0]);
      joint_t to = joint(link[1]);
      if (from != null && to != null) {
        lines.add(new Line(from.position_m, to.position_m, colorOf(link[1])));
      }
    }
    return lines;
  }

  /** From the wrist of each arm that points. */
  List<Line> rays() {
    List<Line> lines = new ArrayList<>();
    for (pointing_t arm : person.pointing) {
      joint_t wrist = joint(arm.side == pointing_t.LEFT ? "wrist_left" : "wrist_right");
      if (wrist != null && isFinite(arm.direction)) {
        lines.add(new Line(wrist.position_m, end(wrist.position_m, arm.direction), RAY));
      }
    }
    return lines;
  }

  /** Those that were found, predicted ones among them. */
  List<joint_t> joints() {
    List<joint_t> found = new ArrayList<>(Arrays.asList(person.joints));
    found.removeIf(joint -> joint.valid == 0 || !isFinite(joint.position_m));
    return found;
  }

  /** Null where it was left out. */
  joint_t joint(String name) {
    for (joint_t joint : joints()) {
      if (joint.name.equals(name)) {
        return joint;
      }
    }
    return null;
  }

  private static Color colorOf(String joint) {
    if (joint.endsWith("_left")) {
      return LEFT;
    }
    return joint.endsWith("_right") ? RIGHT : TRUNK;
  }

  private static float[] end(float[] from, float[] direction) {
    return new float[] {
      from[0] + RAY_LENGTH * direction[0],
      from[1] + RAY_LENGTH * direction[1],
      from[2] + RAY_LENGTH * direction[2]
    };
  }

  private static boolean isFinite(float[] vector) {
    return Float.isFinite(vector[0]) && Float.isFinite(vector[1]) && Float.isFinite(vector[2]);
  }
}
