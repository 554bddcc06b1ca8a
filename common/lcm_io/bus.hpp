#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "common/lcm_io/decode.hpp"
#include "common/lcm_io/encode.hpp"
#include "common/lcm_io/group_membership.hpp"

namespace limbcast::lcm_io {

/// This host only, unless the user says otherwise: LCM has no authentication.
inline constexpr const char* kDefaultUrl = "udpm://239.255.76.67:7667?ttl=0";

/// `url` if given, else $LCM_DEFAULT_URL, else kDefaultUrl. Throws config::UsageError where it is
/// malformed.
std::string chosen_url(const std::string& url);
/// The chosen URL with the receive buffer that limbcast needs, where it names none.
std::string effective_url(const std::string& url);

/// Returns when messages can be sent to the URL's group: at once where a route is there, else when
/// the link of a host that just starts has come up. Says on stderr that it waits, and for what.
void wait_for_network(const std::string& url);

/// What a subscriber keeps while it works on a message.
enum class Keep {
  kNewest,  ///< the newest message of each source; older ones are skipped and counted
  kAll,     ///< every message: calibrations, offline tools
};

/// Whose a message is, by its bytes. Asked by the receiving thread; must not throw.
using SourceOf = std::function<std::string(const std::vector<std::uint8_t>&)>;

/// A message as it came, whatever its type.
struct ReceivedMessage {
  std::string channel;
  std::int64_t received_utime = 0;  ///< when its last packet reached this host [us]
  std::vector<std::uint8_t> bytes;
};

/// LCM with lambdas. A thread of its own receives, so that a slow handler makes LCM lose nothing;
/// the handlers run in the thread that calls handle(), in order of arrival.
///
/// LCM's own queue of one would keep the oldest message and drop the newest, so the choice is made
/// here.
class Bus {
 public:
  /// Throws config::UsageError where LCM cannot be started with the URL. A receive buffer larger
  /// than the kernel gives is told on stderr, and what it gives is used.
  explicit Bus(const std::string& url);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// `handler` gets each message that could be decoded. A MessageError (of decoding or thrown by
  /// it) drops the message and goes to on_malformed; what else it throws comes out of handle().
  /// Without `source_of` all are of one source.
  template <class Message>
  void subscribe(const std::string& channel, Keep keep, std::function<void(const Message&)> handler,
                 const SourceOf& source_of = nullptr) {
    const auto decoded = [handler = std::move(handler)](const ReceivedMessage& message) {
      handler(decode<Message>(message.bytes));
    };
    subscribe_bytes(channel, keep, decoded, source_of);
  }
  /// Every message on every channel.
  void subscribe_everything(std::function<void(const ReceivedMessage&)> handler) {
    subscribe_bytes(".*", Keep::kAll, std::move(handler), nullptr);
  }

  /// Empty: sent as far as this host can tell; else why not. LCM tells it only for messages below
  /// 64 kB.
  template <class Message>
  std::string publish(const std::string& channel, const Message& message) {
    return publish_bytes(channel, encode(message));
  }

  /// Subscriptions of the newest message are handled only while `open` tells so; meanwhile newer
  /// messages take the older ones' places, as ever. Asked in the thread that calls handle().
  void set_gate(std::function<bool()> open) { gate_ = std::move(open); }

  /// Runs the handler of the message that came first; waits for one up to `timeout`. False: none
  /// came.
  bool handle(std::chrono::milliseconds timeout);

  /// Called with channel and reason for each message that was dropped as malformed.
  void set_on_malformed(
      std::function<void(const std::string& channel, const std::string& reason)> callback);
  /// Messages left out so far because a newer one was there.
  std::int64_t skipped() const;

 private:
  struct Pending {
    std::int64_t order;
    std::string source;
    ReceivedMessage message;
  };
  struct Subscription {
    Bus* bus;
    Keep keep;
    std::function<void(const ReceivedMessage&)> handler;
    SourceOf source_of;
    std::deque<Pending> pending;  ///< in order of arrival
  };

  void subscribe_bytes(const std::string& channel, Keep keep,
                       std::function<void(const ReceivedMessage&)> handler, SourceOf source_of);
  /// Makes room for a source's newest message.
  void skip_older(Subscription& subscription, const std::string& source);
  std::string publish_bytes(const std::string& channel, const std::vector<std::uint8_t>& bytes);
  static void on_message(const lcm_recv_buf_t* buffer, const char* channel, void* context);
  void receive();
  Subscription* first_pending();

  lcm::LCM lcm_;
  GroupMembership membership_;
  std::vector<std::unique_ptr<Subscription>> subscriptions_;
  std::function<void(const std::string&, const std::string&)> on_malformed_;
  std::function<bool()> gate_ = [] { return true; };
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::int64_t next_order_ = 0, skipped_ = 0;
  bool ending_ = false;
  std::thread receiver_;
};

}  // namespace limbcast::lcm_io
