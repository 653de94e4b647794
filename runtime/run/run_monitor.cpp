#include "runtime/run/run_monitor.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "runtime/report/budget_account.h"
#include "runtime/run/monitor_feed.h"
#include "runtime/run/monitor_output.h"

namespace gazeloop::run {

RunMonitor::RunMonitor(std::optional<latency::LatencyBudget> budget) : budget_(std::move(budget)) {}

RunMonitor::~RunMonitor() = default;

void RunMonitor::open(const Options& options) {
    const bool watched = options.panel || options.json_fd;
    if (watched) {
        output_ = std::make_unique<MonitorOutput>(MonitorOutputOptions{
            .panel = options.panel,
            .json_fd = options.json_fd,
            .budget = budget_,
            .clock = options.display.clock == latency::LoopClock::Wall ? "wall" : "virtual"});
    }
    if (watched || budget_) {
        feed_ =
            std::make_unique<MonitorFeed>(MonitorFeed::Options{.display = options.display,
                                                               .budget = budget_,
                                                               .window_ns = options.window_ns,
                                                               .interval_ns = options.interval_ns,
                                                               .output = output_.get()});
    }
}

void RunMonitor::join(std::vector<frame::FrameObserver*>& observers) {
    if (feed_ != nullptr) {
        feed_->tell(observers);
        observers.push_back(feed_.get());
    }
}

void RunMonitor::close() {
    if (feed_ != nullptr) {
        last_ = feed_->finish();
        feed_.reset();
    }
    output_.reset();
}

std::string RunMonitor::text() const {
    return budget_ && last_ ? fmt::format("\n{}", report::budget_account_text(*last_, *budget_))
                            : "";
}

void RunMonitor::add_to(nlohmann::ordered_json& json) const {
    if (budget_ && last_) {
        json["budget"] = report::budget_account_json(*last_, *budget_);
    }
}

}  // namespace gazeloop::run
