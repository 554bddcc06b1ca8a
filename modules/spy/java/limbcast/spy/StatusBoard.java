package limbcast.spy;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import limbcast.module_status_t;

/**
 * What all modules of all hosts told last, by the rules of limbcast-status. Knows no clock: each
 * call is told the time in seconds.
 */
final class StatusBoard {
  /** One line of the table. */
  static final class Row {
    final module_status_t status;
    final double age;
    /** As the module says, or "silent". */
    final String state;

    Row(module_status_t status, double age, String state) {
      this.status = status;
      this.age = age;
      this.state = state;
    }
  }

  private static final class Entry {
    final module_status_t status;
    final double heard;

    Entry(module_status_t status, double heard) {
      this.status = status;
      this.heard = heard;
    }

    boolean isSilent(double now) {
      return now - heard > SILENT_AFTER;
    }
  }

  /** Three of a module's messages are missing. */
  private static final double SILENT_AFTER = 3.0;
  private static final double FORGET_AFTER = 60.0;
  /** No more than a robot can have: who floods the channel fills no memory. */
  private static final int MAX_MODULES = 500;

  private final Map<String, Entry> entries = new TreeMap<>();

  void take(module_status_t status, double now) {
    String process = place(status) + '\n' + status.pid;
    if (entries.size() < MAX_MODULES || entries.containsKey(process)) {
      entries.put(process, new Entry(status, now));
    }
  }

  /**
   * By host and module. A silent process whose place another took was started again and is left
   * out.
   */
  List<Row> rows(double now) {
    entries.values().removeIf(entry -> now - entry.heard > FORGET_AFTER);
    List<Row> rows = new ArrayList<>();
    for (Entry entry : entries.values()) {
      boolean silent = entry.isSilent(now);
      if (!silent || !hasSuccessor(entry, now)) {
        rows.add(new Row(entry.status, now - entry.heard, silent ? "silent" : entry.status.state));
      }
    }
    return rows;
  }

  private boolean hasSuccessor(Entry entry, double now) {
    return entries.values().stream()
        .anyMatch(other -> place(other.status).equals(place(entry.status)) && !other.isSilent(now));
  }

  private static String place(module_status_t status) {
    return status.host + '\n' + status.module;
  }
}
