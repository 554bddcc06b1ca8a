package limbcast.spy;

import java.awt.AWTError;
import java.awt.GraphicsEnvironment;
import java.awt.HeadlessException;
import java.io.IOException;
import lcm.lcm.LCM;
import lcm.spy.Spy;

/**
 * Starts lcm-spy. Where its window cannot be shown it would end with a stack trace, and where LCM's
 * URL is wrong it would stay after one, without a window.
 */
public final class Start {
  private static final int WRONG_USAGE = 2;

  private Start() {}

  public static void main(String[] arguments) {
    checkDisplay();
    checkUrl(System.getenv("LCM_DEFAULT_URL"));
    Spy.main(arguments);
  }

  private static void checkDisplay() {
    try {
      GraphicsEnvironment.getLocalGraphicsEnvironment().getDefaultScreenDevice();
    } catch (HeadlessException | AWTError | UnsatisfiedLinkError error) {
      refuse(
          "there is no display for its window ("
              + reason(error)
              + "); start it on a desktop or through ssh -X,"
              + " or take limbcast-status and limbcast-viewer --png");
    }
  }

  /** limbcast-spy has put there what its arguments say. */
  private static void checkUrl(String url) {
    if (url == null || url.isEmpty()) {
      return;
    }
    try {
      new LCM(url).close();
    } catch (IOException | IllegalArgumentException error) {
      refuse(
          "lcm-url '"
              + url
              + "': "
              + error.getMessage()
              + "; write it like udpm://239.255.76.67:7667?ttl=1");
    }
  }

  private static void refuse(String text) {
    System.err.println("limbcast-spy: " + text);
    System.exit(WRONG_USAGE);
  }

  /** In one line; Java's own text has several. */
  private static String reason(Throwable error) {
    String display = System.getenv("DISPLAY");
    if (display == null || display.isEmpty()) {
      return "DISPLAY is not set";
    }
    return "DISPLAY is " + display + ", " + error.getMessage().strip().replaceAll("\\s+", " ");
  }
}
