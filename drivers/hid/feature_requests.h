#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <future>
#include <mutex>
#include <vector>

#include "drivers/device/tracker_device.h"
#include "drivers/hid/hidraw_device.h"

namespace gazeloop::drivers::hid {

/// What a tracker is asked, one request after the other, by a thread of their own: a device that
/// does not answer costs seconds each, in which its reports are to be read. (Linux opens and closes
/// no hidraw node meanwhile, of any device.) To be used by one thread.
class FeatureRequests {
  public:
    struct Request {
        std::uint8_t id = 0;
        std::size_t payload_bytes = 0;   ///< of a report that is to be read
        std::vector<std::uint8_t> sent;  ///< id first; empty: to be read
    };
    struct Outcome {
        std::uint8_t id = 0;
        bool sent = false;
        /// What was read, id first; empty where something was sent.
        std::expected<std::vector<std::uint8_t>, RequestFailure> answer;
    };

    /// After so many without an answer the others are not made: the device answers none.
    static constexpr int kMostUnanswered = 2;

    /// `stop` is asked before each request, by the other thread; the device has to outlive this.
    FeatureRequests(HidrawDevice& device, StopRequested stop);
    FeatureRequests(const FeatureRequests&) = delete;
    FeatureRequests& operator=(const FeatureRequests&) = delete;
    /// Waits for the request that is being made, for as long as that takes.
    ~FeatureRequests();

    /// Makes these requests; none may be left of those before.
    void make(std::vector<Request> requests);
    /// Waits for at most so long until all are made; whether they are. Throws what kept them from
    /// it (std::bad_alloc).
    [[nodiscard]] bool done(std::chrono::milliseconds longest = {});
    /// What has come of them since the last call. Those that were not made because of `stop` are
    /// missing.
    [[nodiscard]] std::vector<Outcome> take();

    /// Makes none of those that are left, and waits for the one that is being made.
    void end();

  private:
    void run(const std::vector<Request>& requests);

    HidrawDevice& device_;
    StopRequested stop_;
    std::atomic<bool> ending_{false};
    std::mutex mutex_;
    std::vector<Outcome> outcomes_;
    std::future<void> made_;
};

}  // namespace gazeloop::drivers::hid
