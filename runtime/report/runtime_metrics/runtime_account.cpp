#include "runtime/report/runtime_metrics/runtime_account.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

namespace gazeloop::report {

Expected<RuntimeAccount> RuntimeAccount::open(const RuntimeFiles& files,
                                              const std::string& noted_metrics) {
    RuntimeAccount account;
    const bool noted = files.metrics.empty() && !noted_metrics.empty();
    if (const std::string& file = noted ? noted_metrics : files.metrics; !file.empty()) {
        auto reader = MonadoMetricsReader::open(file);
        if (reader) {
            account.metrics_ = std::make_unique<MonadoMetricsReader>(std::move(*reader));
        } else if (noted) {
            account.noted_problem_ = std::move(reader.error().message);
        } else {
            return std::unexpected(std::move(reader.error()));
        }
    }
    if (!files.csv.empty()) {
        auto reader = WivrnCsvReader::open(files.csv);
        if (!reader) {
            return std::unexpected(std::move(reader.error()));
        }
        account.wivrn_ = std::make_unique<WivrnStages>(std::move(*reader));
    }
    return account;
}

std::span<frame::FrameObserver* const> RuntimeAccount::joined(
    std::span<frame::FrameObserver* const> observers) {
    told_.assign(observers.begin(), observers.end());
    if (metrics_) {
        join_ = std::make_unique<RuntimeMetricsJoin>(std::move(*metrics_), observers);
        metrics_.reset();
        told_.assign(1, join_.get());
    }
    if (wivrn_) {
        told_.push_back(wivrn_.get());
    }
    return told_;
}

std::string RuntimeAccount::text() const {
    std::string text;
    if (join_) {
        text.append("\n").append(join_->text());
    }
    if (!noted_problem_.empty()) {
        text += fmt::format(
            "\nruntime  XRT_METRICS_FILE was set in this run, but no metrics were read\n  {}\n"
            "  Only monado-service writes them, started with that variable; the runtime inside\n"
            "  a program does not.\n",
            noted_problem_);
    }
    if (wivrn_) {
        text.append("\n").append(wivrn_->text());
    }
    return text;
}

void RuntimeAccount::add_to(nlohmann::ordered_json& summary) const {
    summary["runtime_metrics"] = nullptr;
    summary["runtime_csv"] = nullptr;
    if (join_) {
        summary["runtime_metrics"] = join_->json();
    } else if (!noted_problem_.empty()) {
        summary["runtime_metrics"] = {{"error", noted_problem_}};
    }
    if (wivrn_) {
        summary["runtime_csv"] = wivrn_->json();
    }
}

}  // namespace gazeloop::report
