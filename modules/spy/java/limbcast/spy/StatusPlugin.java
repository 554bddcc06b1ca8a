package limbcast.spy;

import javax.swing.Action;
import javax.swing.JDesktopPane;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;
import limbcast.module_status_t;

/** MODULE_STATUS as a table of the modules of all hosts. */
public final class StatusPlugin implements SpyPlugin {
  @Override
  public boolean canHandle(long fingerprint) {
    return fingerprint == module_status_t.LCM_FINGERPRINT;
  }

  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return new OpenView<>(
        "Modules", desktop, channel, module_status_t.class, module_status_t::new, StatusView::new);
  }
}
