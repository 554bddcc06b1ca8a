#include "common/sources/pipeline_reader.hpp"

#include <gst/gst.h>

#include <algorithm>
#include <utility>

#include "common/input_error.hpp"
#include "common/sources/capture_time.hpp"

namespace limbcast {
namespace {

/// A live pipeline may wait for its sender; one that cannot play says so sooner than this.
constexpr GstClockTime kLongestStart = 2 * GST_SECOND;
/// How often a reader without pictures looks whether its pipeline failed.
constexpr guint64 kLook = GST_SECOND / 10;

struct Release {
  void operator()(GError* error) const { g_error_free(error); }
  void operator()(gchar* text) const { g_free(text); }
  void operator()(GstMessage* message) const { gst_message_unref(message); }
  void operator()(GstSample* sample) const { gst_sample_unref(sample); }
  void operator()(GstBus* bus) const { gst_object_unref(bus); }
  void operator()(GstElement* element) const { gst_object_unref(element); }
};
template <class T>
using Owned = std::unique_ptr<T, Release>;

struct StopAndRelease {
  void operator()(GstElement* pipeline) const {
    gst_element_set_state(pipeline, GST_STATE_NULL);
    gst_object_unref(pipeline);
  }
};
using Pipeline = std::unique_ptr<GstElement, StopAndRelease>;

const std::string kTry = "; try it with gst-launch-1.0 and a sink (package gstreamer1.0-tools)";

/// Of GObject, in this thread: that a property cannot take a value, and goes without it.
thread_local std::string warning;

/// Others, as of a plugin that is installed twice, are no fault of the pipeline's.
void keep_warning(const gchar* domain, GLogLevelFlags level, const gchar* text, gpointer data) {
  if (std::string(text).find("for property") == std::string::npos)
    return g_log_default_handler(domain, level, text, data);
  warning = text;
}

/// Else they go to stderr only.
void keep_warnings() {
  [[maybe_unused]] static const guint handler =
      g_log_set_handler("GLib-GObject", G_LOG_LEVEL_WARNING, &keep_warning, nullptr);
  warning.clear();
}

Pipeline parse(const std::string& name, const std::string& text) {
  constexpr auto kFlags =
      static_cast<GstParseFlags>(GST_PARSE_FLAG_FATAL_ERRORS | GST_PARSE_FLAG_PLACE_IN_BIN);
  keep_warnings();
  GError* failure = nullptr;
  if (gst_init_check(nullptr, nullptr, &failure) != FALSE) {
    GstElement* const bin = gst_parse_launch_full(text.c_str(), nullptr, kFlags, &failure);
    if (bin != nullptr) {
      Pipeline pipeline(gst_pipeline_new(nullptr));
      gst_bin_add(GST_BIN(pipeline.get()), bin);
      if (!warning.empty()) throw InputError(name + ": " + warning + kTry);
      return pipeline;
    }
  }
  const Owned<GError> error(failure);
  const bool lacks_element =
      g_error_matches(failure, GST_PARSE_ERROR, GST_PARSE_ERROR_NO_SUCH_ELEMENT) != FALSE;
  throw InputError(name + ": " + error->message +
                   (lacks_element ? "; is the name right? Elements are in the packages "
                                    "gstreamer1.0-plugins-base, -good (V4L2, JPEG, RTP), -bad, "
                                    "-ugly and gstreamer1.0-libav"
                                  : kTry));
}

/// Whether data can begin in this element: in one without inputs. What holds others does not count.
bool is_source(const GstElement* element) {
  return element->numsinkpads == 0 && G_OBJECT_TYPE(element) != GST_TYPE_BIN;
}

/// Without a source no picture would ever come, and no error.
void require_source(const std::string& name, const Pipeline& pipeline) {
  GstIterator* const elements = gst_bin_iterate_recurse(GST_BIN(pipeline.get()));
  GValue element = G_VALUE_INIT;
  bool found = false;
  while (!found && gst_iterator_next(elements, &element) == GST_ITERATOR_OK)
    found = is_source(GST_ELEMENT(g_value_get_object(&element)));
  g_value_unset(&element);
  gst_iterator_free(elements);
  if (!found)
    throw InputError(name +
                     ": has no element that pictures come from; begin it with one, as "
                     "v4l2src or rtspsrc");
}

Owned<GstElement> appsink_of(const std::string& name, const Pipeline& pipeline) {
  GstIterator* const sinks =
      gst_bin_iterate_all_by_element_factory_name(GST_BIN(pipeline.get()), "appsink");
  GValue first = G_VALUE_INIT;
  Owned<GstElement> sink;
  if (gst_iterator_next(sinks, &first) == GST_ITERATOR_OK) {
    sink.reset(GST_ELEMENT(g_value_dup_object(&first)));
    g_value_unset(&first);
  }
  gst_iterator_free(sinks);
  if (!sink) throw InputError(name + ": has no appsink, only the word; end it with '! appsink'");
  return sink;
}

/// "v4l2src0: Cannot identify device '/dev/video9'. (system error: No such file or directory)"
std::string reason_in(GstMessage& message) {
  GError* error = nullptr;
  gchar* debug = nullptr;
  gst_message_parse_error(&message, &error, &debug);
  const Owned<GError> owned_error(error);
  const Owned<gchar> owned_debug(debug);
  std::string reason = std::string(GST_MESSAGE_SRC_NAME(&message)) + ": " + error->message;
  // Its first line is the place in GStreamer's source.
  std::string details = debug != nullptr ? debug : "";
  details.erase(0, std::min(details.find('\n'), details.size()));
  if (!details.empty()) reason += " (" + details.substr(1) + ")";
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  return reason;
}

/// Of the formats that appsinks are told to take.
int pixel_type(const std::string& format) {
  if (format == "BGR") return CV_8UC3;
  return format == "GRAY8" ? CV_8UC1 : CV_16UC1;
}

class PipelineReader : public FrameReader {
 public:
  PipelineReader(std::string name, const std::string& text)
      : name_(std::move(name)),
        pipeline_(parse(name_, text)),
        bus_(gst_element_get_bus(pipeline_.get())),
        sink_(appsink_of(name_, pipeline_)) {
    require_source(name_, pipeline_);
    gst_util_set_object_arg(G_OBJECT(sink_.get()), "caps",
                            "video/x-raw,format=(string){BGR,GRAY8,GRAY16_LE}");
    const bool live = set_state(GST_STATE_PAUSED) == GST_STATE_CHANGE_NO_PREROLL;
    if (set_state(GST_STATE_PLAYING) != GST_STATE_CHANGE_ASYNC) return;
    // The first picture ends the start.
    wait_for(GST_MESSAGE_ASYNC_DONE, live ? kLongestStart : GST_CLOCK_TIME_NONE);
  }

  std::optional<CapturedFrame> read() override {
    gboolean ended = FALSE;
    while (true) {
      fail_if_told();
      if (ended != FALSE) return std::nullopt;
      GstSample* pulled = nullptr;
      g_signal_emit_by_name(sink_.get(), "try-pull-sample", kLook, &pulled);
      const Owned<GstSample> sample(pulled);
      if (sample) return CapturedFrame{read_clocks().utime, {pixels_of(*sample)}};
      g_object_get(sink_.get(), "eos", &ended, nullptr);
    }
  }

 private:
  GstStateChangeReturn set_state(GstState state) const {
    const GstStateChangeReturn change = gst_element_set_state(pipeline_.get(), state);
    if (change == GST_STATE_CHANGE_FAILURE) {
      fail_if_told();
      throw InputError(name_ + ": cannot be started" + kTry);
    }
    return change;
  }

  /// Throws where the pipeline tells an error before.
  void wait_for(GstMessageType wanted, GstClockTime timeout) const {
    const auto types = static_cast<GstMessageType>(wanted | GST_MESSAGE_ERROR);
    const Owned<GstMessage> message(gst_bus_timed_pop_filtered(bus_.get(), timeout, types));
    if (message && GST_MESSAGE_TYPE(message.get()) == GST_MESSAGE_ERROR) {
      throw InputError(name_ + ": " + reason_in(*message) + kTry);
    }
  }
  void fail_if_told() const { wait_for(GST_MESSAGE_UNKNOWN, 0); }

  cv::Mat pixels_of(GstSample& sample) const {
    const GstStructure* const caps = gst_caps_get_structure(gst_sample_get_caps(&sample), 0);
    cv::Size size;
    gst_structure_get_int(caps, "width", &size.width);
    gst_structure_get_int(caps, "height", &size.height);
    const int type = pixel_type(gst_structure_get_string(caps, "format"));
    // GStreamer's rows begin at multiples of 4 bytes.
    const std::size_t row_bytes =
        GST_ROUND_UP_4(static_cast<std::size_t>(size.width) * CV_ELEM_SIZE(type));
    GstBuffer* const buffer = gst_sample_get_buffer(&sample);
    GstMapInfo bytes;
    cv::Mat pixels;
    if (gst_buffer_map(buffer, &bytes, GST_MAP_READ) != FALSE) {
      const bool whole = bytes.size >= row_bytes * static_cast<std::size_t>(size.height);
      if (whole) pixels = cv::Mat(size, type, bytes.data, row_bytes).clone();
      gst_buffer_unmap(buffer, &bytes);
    }
    if (pixels.empty()) throw InputError(name_ + ": gives a torn picture" + kTry);
    return pixels;
  }

  const std::string name_;
  const Pipeline pipeline_;
  const Owned<GstBus> bus_;
  const Owned<GstElement> sink_;
};

}  // namespace

std::unique_ptr<FrameReader> open_pipeline(const std::string& name, const std::string& pipeline,
                                           bool raw_depth) {
  std::string whole = pipeline;
  if (pipeline.find("appsink") == std::string::npos) {
    // A conversion would take depth for grey values and drop half of their bits.
    if (!raw_depth) whole += " ! videoconvert ! video/x-raw,format=(string){BGR,GRAY8}";
    whole += " ! appsink max-buffers=2 drop=true sync=false";
  }
  return std::make_unique<PipelineReader>(name, whole);
}

}  // namespace limbcast
