#include "drivers/simulated/ahead_source.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace gazeloop::drivers {
namespace {

/// What the queue holds of the fastest simulated tracker, which takes 10 000 samples a second.
constexpr std::int64_t kAhead_ns = 100'000'000;
constexpr std::size_t kMostReady = 1024;
/// Several times while what is ready lasts, so that a late wake-up of the thread is not noticed.
constexpr std::chrono::milliseconds kPeriod{20};

}  // namespace

AheadSource::AheadSource(std::unique_ptr<GazeSource> source)
    : description_(source->description()), ready_(kMostReady), source_(std::move(source)) {
    over_.reserve(kMostReady);
    thread_.emplace(kPeriod, [this] { work_ahead(); });
}

void AheadSource::poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) {
    asked_ns_.store(now_ns, std::memory_order_relaxed);
    const bool all_ready = ready_until_ns_.load(std::memory_order_acquire) >= now_ns;
    take_ready(now_ns, samples);
    if (all_ready) {
        return;
    }
    const std::lock_guard lock(mutex_);
    take_ready(now_ns, samples);
    compute(now_ns);
    const auto later = std::ranges::find_if(
        over_, [now_ns](const gaze::GazeSample& sample) { return sample.arrived.ns > now_ns; });
    samples.insert(samples.end(), over_.begin(), later);
    over_.erase(over_.begin(), later);
    publish_until();
    finished_ = source_->finished() && over_.empty() && ready_.front() == nullptr;
}

void AheadSource::take_ready(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) {
    const gaze::GazeSample* sample = ready_.front();
    while (sample != nullptr && sample->arrived.ns <= now_ns) {
        samples.push_back(*sample);
        ready_.pop();
        sample = ready_.front();
    }
}

void AheadSource::compute(std::int64_t until_ns) {
    if (until_ns > computed_until_ns_) {
        source_->poll(until_ns, over_);
        computed_until_ns_ = until_ns;
    }
}

void AheadSource::publish_until() {
    ready_until_ns_.store(over_.empty() ? computed_until_ns_ : over_.front().arrived.ns - 1,
                          std::memory_order_release);
}

void AheadSource::work_ahead() {
    const std::int64_t asked_ns = asked_ns_.load(std::memory_order_relaxed);
    if (asked_ns == kNever_ns || asked_ns > std::numeric_limits<std::int64_t>::max() - kAhead_ns) {
        return;
    }
    const std::lock_guard lock(mutex_);
    if (over_.empty()) {
        try {
            compute(asked_ns + kAhead_ns);
        } catch (...) {
            return;  // whoever polls it meets the same, and can say so
        }
    }
    const auto left = std::ranges::find_if_not(
        over_, [this](const gaze::GazeSample& sample) { return ready_.try_push(sample); });
    over_.erase(over_.begin(), left);
    publish_until();
}

}  // namespace gazeloop::drivers
