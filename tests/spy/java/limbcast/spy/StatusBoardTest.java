package limbcast.spy;

import static org.junit.Assert.assertEquals;

import java.util.stream.Collectors;
import limbcast.module_status_t;
import org.junit.Test;

public class StatusBoardTest {
  private final StatusBoard board = new StatusBoard();

  private static module_status_t status(String host, String module, int pid) {
    module_status_t status = new module_status_t();
    status.host = host;
    status.module = module;
    status.pid = pid;
    status.state = "running";
    return status;
  }

  private String rows(double now) {
    return board.rows(now).stream()
        .map(row -> row.status.host + " " + row.status.module + " " + row.state)
        .collect(Collectors.joining(", "));
  }

  @Test
  public void listsModulesByHostAndName() {
    board.take(status("vision", "segmenter", 3), 0.0);
    board.take(status("vision", "pose_fitter", 4), 0.0);
    board.take(status("camera", "stereo_camera", 5), 0.0);
    assertEquals(
        "camera stereo_camera running, vision pose_fitter running, vision segmenter running",
        rows(1.0));
  }

  @Test
  public void callsAModuleSilentThenForgetsIt() {
    board.take(status("vision", "segmenter", 3), 0.0);
    assertEquals("vision segmenter silent", rows(3.5));
    assertEquals(3.5, board.rows(3.5).get(0).age, 1e-9);
    assertEquals("", rows(60.5));
  }

  @Test
  public void leavesOutAProcessThatWasStartedAgain() {
    board.take(status("vision", "segmenter", 3), 0.0);
    board.take(status("vision", "segmenter", 8), 4.0);
    assertEquals("vision segmenter running", rows(4.0));
  }

  @Test
  public void showsBothOfTwoThatRun() {
    board.take(status("vision", "segmenter", 3), 0.0);
    board.take(status("vision", "segmenter", 8), 0.5);
    assertEquals("vision segmenter running, vision segmenter running", rows(1.0));
  }

  @Test
  public void takesNoMoreModulesThanARobotHas() {
    for (int pid = 0; pid < 600; ++pid) {
      board.take(status("vision", "segmenter", pid), 0.0);
    }
    assertEquals(500, board.rows(0.0).size());
  }
}
