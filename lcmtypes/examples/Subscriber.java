// Prints where the people's heads are and where they point, of each frame.
import lcm.lcm.LCM;
import limbcast.*;

class Subscriber {
  static void onPoses(body_poses_t poses) {
    System.out.printf("frame %d: %d persons%n", poses.stamp.sequence, poses.num_persons);
    for (body_pose_t person : poses.persons) {
      for (joint_t joint : person.joints)
        if (joint.valid != 0 && joint.name.equals("head")) print("head at", joint.position_m, "m");
      for (pointing_t arm : person.pointing) print("points to", arm.direction, "");
    }
  }

  static void print(String what, float[] v, String unit) {
    System.out.printf("  %s %.2f %.2f %.2f %s%n", what, v[0], v[1], v[2], unit);
  }

  public static void main(String[] arguments) throws Exception {
    new LCM().subscribe("BODY_POSES", (lcm, channel, in) -> {  // as $LCM_DEFAULT_URL says
      try {
        onPoses(new body_poses_t(in));
      } catch (java.io.IOException error) {
        System.err.println(channel + ": " + error.getMessage());
      }
    });
    Thread.currentThread().join();
  }
}
