// Prints where the people's heads are and where they point, of each frame.
#include <cstdio>
#include <lcm/lcm-cpp.hpp>
#include <limbcast/body_poses_t.hpp>

static void on_poses(const lcm::ReceiveBuffer*, const std::string&,
                     const limbcast::body_poses_t* poses, void*) {
  std::printf("frame %lld: %d persons\n", static_cast<long long>(poses->stamp.sequence),
              poses->num_persons);
  for (const auto& person : poses->persons) {
    for (const auto& joint : person.joints)
      if (joint.valid != 0 && joint.name == "head")
        std::printf("  head at %.2f %.2f %.2f m\n", joint.position_m[0], joint.position_m[1],
                    joint.position_m[2]);
    for (const auto& arm : person.pointing)
      std::printf("  points to %.2f %.2f %.2f\n", arm.direction[0], arm.direction[1],
                  arm.direction[2]);
  }
  std::fflush(stdout);
}

int main() {
  lcm::LCM lcm;  // as $LCM_DEFAULT_URL says
  if (!lcm.good()) return 1;
  lcm.subscribeFunction<limbcast::body_poses_t, void*>("BODY_POSES", on_poses, nullptr);
  while (lcm.handle() == 0) continue;
}
