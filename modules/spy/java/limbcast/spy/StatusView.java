package limbcast.spy;

import java.awt.Color;
import java.awt.Component;
import java.util.List;
import java.util.Locale;
import java.util.function.Function;
import javax.swing.JComponent;
import javax.swing.JScrollPane;
import javax.swing.JTable;
import javax.swing.SwingUtilities;
import javax.swing.Timer;
import javax.swing.table.AbstractTableModel;
import javax.swing.table.DefaultTableCellRenderer;
import limbcast.module_status_t;

/** The status board as a table: yellow where a module waits, red where it fails or is silent. */
final class StatusView implements MessageView<module_status_t> {
  static final Color WAITING = new Color(255, 245, 190);
  static final Color IN_ERROR = new Color(255, 200, 190);

  private static final double NANOSECONDS = 1e9;
  /** Ages go on while nothing comes. */
  private static final int REFRESH_MS = 500;

  private enum Column {
    HOST("host", 70, row -> row.status.host),
    MODULE("module", 115, row -> row.status.module),
    STATE("state", 60, row -> row.state),
    RATE_IN("in/s", 45, row -> number(row.status.rate_in_hz, 1)),
    RATE_OUT("out/s", 45, row -> number(row.status.rate_out_hz, 1)),
    LATENCY_P50("p50 ms", 60, row -> latency(row.status.latency_p50_ms)),
    LATENCY_P99("p99 ms", 60, row -> latency(row.status.latency_p99_ms)),
    LOST("lost", 45, row -> Long.toString(row.status.num_lost)),
    SKIPPED("skipped", 60, row -> Long.toString(row.status.num_skipped)),
    MALFORMED("malformed", 78, row -> Long.toString(row.status.num_malformed)),
    AGE("age s", 45, row -> number(row.age, 1)),
    LAST_ERROR("last error", 150, row -> row.status.last_error),
    NOTE("note", 150, row -> row.status.note);

    final String title;
    final int width;
    final Function<StatusBoard.Row, String> text;

    Column(String title, int width, Function<StatusBoard.Row, String> text) {
      this.title = title;
      this.width = width;
      this.text = text;
    }
  }

  private final StatusBoard board = new StatusBoard();
  private final Model model = new Model();
  private final JTable table = new JTable(model);
  private final JScrollPane component = new JScrollPane(table);

  StatusView() {
    table.setDefaultRenderer(Object.class, new Renderer());
    table.setAutoResizeMode(JTable.AUTO_RESIZE_LAST_COLUMN);
    for (Column column : Column.values()) {
      table.getColumnModel().getColumn(column.ordinal()).setPreferredWidth(column.width);
    }
    Timer timer = new Timer(REFRESH_MS, event -> model.refresh());
    component.addHierarchyListener(
        change -> {
          if (component.isShowing()) {
            timer.start();
          } else {
            timer.stop();
          }
        });
  }

  @Override
  public JComponent component() {
    return component;
  }

  @Override
  public void show(module_status_t status) {
    SwingUtilities.invokeLater(
        () -> {
          board.take(status, now());
          model.refresh();
        });
  }

  private static double now() {
    return System.nanoTime() / NANOSECONDS;
  }

  /** An older age says when a recording that is played was made, not how fast the module is. */
  private static String latency(double milliseconds) {
    final double oldestLiveMs = 60_000;
    return number(milliseconds < oldestLiveMs ? milliseconds : Double.NaN, 0);
  }

  private static String number(double value, int digits) {
    return Double.isFinite(value) ? String.format(Locale.ROOT, "%." + digits + "f", value) : "-";
  }

  private final class Model extends AbstractTableModel {
    private List<StatusBoard.Row> rows = List.of();

    void refresh() {
      rows = board.rows(now());
      fireTableDataChanged();
    }

    StatusBoard.Row row(int index) {
      return rows.get(index);
    }

    @Override
    public int getRowCount() {
      return rows.size();
    }

    @Override
    public int getColumnCount() {
      return Column.values().length;
    }

    @Override
    public String getColumnName(int column) {
      return Column.values()[column].title;
    }

    @Override
    public Object getValueAt(int row, int column) {
      return Column.values()[column].text.apply(rows.get(row));
    }
  }

  private final class Renderer extends DefaultTableCellRenderer {
    @Override
    public Component getTableCellRendererComponent(
        JTable owner, Object value, boolean selected, boolean focused, int row, int column) {
      super.getTableCellRendererComponent(owner, value, selected, focused, row, column);
      if (!selected) {
        setBackground(colorOf(model.row(row).state, owner.getBackground()));
      }
      setToolTipText((String) value);
      return this;
    }

    private Color colorOf(String state, Color otherwise) {
      switch (state) {
        case "failing":
        case "silent":
          return IN_ERROR;
        case "waiting":
          return WAITING;
        default:
          return otherwise;
      }
    }
  }
}
