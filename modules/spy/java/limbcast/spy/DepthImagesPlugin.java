package limbcast.spy;

import java.awt.image.BufferedImage;
import java.io.IOException;
import java.util.Arrays;
import java.util.List;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;
import limbcast.depth_images_t;

/** DEPTH_IMAGES as pictures: colour on the left, depth in shades of grey on the right. */
public final class DepthImagesPlugin implements SpyPlugin {
  @Override
  public boolean canHandle(long fingerprint) {
    return fingerprint == depth_images_t.LCM_FINGERPRINT;
  }

  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return ImagesView.open(
        desktop, channel, depth_images_t.class, depth_images_t::new, DepthImagesPlugin::decode);
  }

  private static List<BufferedImage> decode(depth_images_t frame) throws IOException {
    BufferedImage depth = Pictures.decode(frame.depth);
    return Arrays.asList(
        Pictures.decode(frame.color),
        depth == null ? null : Pictures.shadesOfDepth(depth, frame.depth_scale_m));
  }
}
