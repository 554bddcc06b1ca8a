package limbcast.spy;

import java.util.Arrays;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;
import limbcast.stereo_images_t;

/** STEREO_IMAGES as pictures: the left camera's on the left. */
public final class StereoImagesPlugin implements SpyPlugin {
  @Override
  public boolean canHandle(long fingerprint) {
    return fingerprint == stereo_images_t.LCM_FINGERPRINT;
  }

  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return ImagesView.open(
        desktop,
        channel,
        stereo_images_t.class,
        stereo_images_t::new,
        pair -> Arrays.asList(Pictures.decode(pair.left), Pictures.decode(pair.right)));
  }
}
