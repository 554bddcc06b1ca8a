#include "common/lcm_io/bus.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "common/bounded_map.hpp"
#include "common/config/log.hpp"
#include "common/config/options.hpp"
#include "common/lcm_io/lcm_url.hpp"

namespace limbcast::lcm_io {
namespace {

/// How long the receiving thread may take to see that it shall end [ms].
constexpr int kReceiveTimeoutMs = 50;
/// How often a host without network is asked again.
constexpr std::chrono::milliseconds kNetworkPeriod{200};
/// How often the group is joined anew, in case the device or the route has changed.
constexpr std::chrono::seconds kMembershipPeriod{1};

/// What to do about a URL that is none of a live bus.
std::string advice_for(const std::string& url) {
  return is_url_of_file(url)
             ? "play a log with lcm-logplayer beside the modules, or give it to limbcast-replay"
             : "write it like udpm://239.255.76.67:7667?ttl=1";
}

/// What LCM is started with.
std::string url_within_limits(const std::string& url) {
  const std::string wanted = effective_url(url);
  const auto limit = receive_buffer_limit();
  if (!limit) return wanted;
  std::string given = with_receive_buffer_of_at_most(*limit, wanted);
  if (given != wanted)
    config::log(config::LogLevel::kWarning,
                "the kernel gives sockets " + std::to_string(*limit / 1000) +
                    " kB instead of what " + wanted +
                    " asks for: large messages are lost when a process is late; "
                    "limbcast-doctor tells how to mend it");
  return given;
}

}  // namespace

std::string chosen_url(const std::string& url) {
  const char* environment = std::getenv("LCM_DEFAULT_URL");
  const std::string otherwise =
      environment != nullptr && *environment != '\0' ? environment : kDefaultUrl;
  const std::string& chosen = url.empty() ? otherwise : url;
  const std::string fault = url_fault(chosen);
  if (!fault.empty())
    throw config::UsageError((url.empty() ? "LCM_DEFAULT_URL '" : "lcm-url '") + chosen +
                             "': " + fault + "; " + advice_for(chosen));
  return chosen;
}

std::string effective_url(const std::string& url) { return with_receive_buffer(chosen_url(url)); }

void wait_for_network(const std::string& url) {
  const auto multicast = parse_multicast_url(effective_url(url));
  if (!multicast) return;
  std::string reason = why_unreachable(*multicast);
  if (reason.empty()) return;
  config::log(config::LogLevel::kWarning,
              "waits for a multicast route to " + multicast->address + " (" + reason +
                  "); without a network: ip route add 224.0.0.0/4 dev lo");
  while (!reason.empty()) {
    std::this_thread::sleep_for(kNetworkPeriod);
    reason = why_unreachable(*multicast);
  }
}

Bus::Bus(const std::string& url) : lcm_(url_within_limits(url)), membership_(effective_url(url)) {
  if (!lcm_.good())
    throw config::UsageError(
        "lcm-url '" + effective_url(url) +
        "': LCM cannot start; check the URL and the multicast route (ip route add "
        "224.0.0.0/4 dev lo)");
  // LCM itself would go on, and end the program where it waits for a message.
  if (lcm_.getFileno() < 0)
    throw config::UsageError("lcm-url '" + effective_url(url) +
                             "': nobody answers there; start lcm-tcpq-server on that host");
}

Bus::~Bus() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  if (receiver_.joinable()) receiver_.join();
}

void Bus::set_on_malformed(std::function<void(const std::string&, const std::string&)> callback) {
  on_malformed_ = std::move(callback);
}

std::int64_t Bus::skipped() const {
  const std::lock_guard lock(mutex_);
  return skipped_;
}

void Bus::subscribe_bytes(const std::string& channel, Keep keep,
                          std::function<void(const ReceivedMessage&)> handler, SourceOf source_of) {
  auto subscription = std::make_unique<Subscription>();
  subscription->bus = this;
  subscription->keep = keep;
  subscription->handler = std::move(handler);
  subscription->source_of = std::move(source_of);
  // The C++ interface does not tell when LCM refuses.
  lcm_subscription_t* made =
      lcm_subscribe(lcm_.getUnderlyingLCM(), channel.c_str(), &Bus::on_message, subscription.get());
  if (made == nullptr)
    throw std::runtime_error("LCM hears nothing of what it sends itself on " + channel +
                             "; check firewall and multicast route with limbcast-doctor");
  // LCM counts a queue for each subscription; ours is emptied at once, so its length only covers
  // bursts.
  constexpr int kReceiveQueue = 1000;
  lcm_subscription_set_queue_capacity(made, kReceiveQueue);
  subscriptions_.push_back(std::move(subscription));
  if (!receiver_.joinable()) receiver_ = std::thread(&Bus::receive, this);
}

std::string Bus::publish_bytes(const std::string& channel, const std::vector<std::uint8_t>& bytes) {
  errno = 0;
  const int status = lcm_.publish(channel, bytes.data(), static_cast<unsigned int>(bytes.size()));
  if (status >= 0) return "";
  return errno != 0 ? std::strerror(errno) : "LCM does not say why";
}

void Bus::on_message(const lcm_recv_buf_t* buffer, const char* channel, void* context) {
  // LCM lets a packet pass that ends within its channel's name, with a size below 0; without bytes
  // it counts as malformed.
  const auto size = std::max(0, static_cast<std::int32_t>(buffer->data_size));
  const auto* data = static_cast<const std::uint8_t*>(buffer->data);
  auto* subscription = static_cast<Subscription*>(context);
  Bus& bus = *subscription->bus;
  ReceivedMessage message{channel, buffer->recv_utime, {data, data + size}};
  std::string source = subscription->source_of ? subscription->source_of(message.bytes) : "";
  const std::lock_guard lock(bus.mutex_);
  if (subscription->keep == Keep::kNewest) bus.skip_older(*subscription, source);
  subscription->pending.push_back({bus.next_order_++, std::move(source), std::move(message)});
  bus.arrived_.notify_one();
}

void Bus::skip_older(Subscription& subscription, const std::string& source) {
  std::deque<Pending>& pending = subscription.pending;
  auto older = std::find_if(pending.begin(), pending.end(),
                            [&](const Pending& other) { return other.source == source; });
  // Anyone can make up sources.
  if (older == pending.end() && pending.size() >= kMostSensors) older = pending.begin();
  if (older == pending.end()) return;
  pending.erase(older);
  ++skipped_;
}

void Bus::receive() {
  const auto ending = [this] {
    const std::lock_guard lock(mutex_);
    return ending_;
  };
  auto next_renewal = std::chrono::steady_clock::now();
  while (!ending()) {
    lcm_.handleTimeout(kReceiveTimeoutMs);
    const auto now = std::chrono::steady_clock::now();
    if (now < next_renewal) continue;
    membership_.renew();
    next_renewal = now + kMembershipPeriod;
  }
}

Bus::Subscription* Bus::first_pending() {
  Subscription* first = nullptr;
  const bool open = gate_();
  for (const auto& subscription : subscriptions_) {
    if (subscription->pending.empty() || (subscription->keep == Keep::kNewest && !open)) continue;
    if (first == nullptr || subscription->pending.front().order < first->pending.front().order)
      first = subscription.get();
  }
  return first;
}

bool Bus::handle(std::chrono::milliseconds timeout) {
  Subscription* subscription = nullptr;
  ReceivedMessage message;
  {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, timeout, [this] { return first_pending() != nullptr; });
    subscription = first_pending();
    if (subscription == nullptr) return false;
    message = std::move(subscription->pending.front().message);
    subscription->pending.pop_front();
  }
  try {
    subscription->handler(message);
  } catch (const MessageError& error) {
    if (on_malformed_) on_malformed_(message.channel, error.what());
  }
  return true;
}

}  // namespace limbcast::lcm_io
