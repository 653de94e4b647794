#include "runtime/run/monitor_output.h"

#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <utility>
#include <vector>

#include "runtime/periodic_thread.h"
#include "runtime/report/monitor_json.h"
#include "runtime/report/monitor_panel.h"
#include "runtime/run/line_writer.h"
#include "runtime/run/terminal_panel.h"
#include "runtime/spsc_queue.h"

namespace gazeloop::run {
namespace {

/// Six seconds of ten pictures and an interval a second, with room for a burst of events: 2 MB.
constexpr std::size_t kQueueRecords = 1024;
constexpr std::chrono::milliseconds kLookInterval{20};
constexpr std::chrono::milliseconds kBetweenPictures{100};  ///< ten a second at most
constexpr std::chrono::milliseconds kBetweenLines{1000};
constexpr int kLastPatience_ms = 100;  ///< for the reader of the last line

}  // namespace

class MonitorOutput::Impl {
  public:
    explicit Impl(const MonitorOutputOptions& options)
        : options_(options), budget_(options.budget ? options.budget->name : std::string()) {
        if (options.panel && TerminalPanel::possible()) {
            panel_ = std::make_unique<TerminalPanel>();
        }
        if (options.json_fd) {
            json_.emplace(*options.json_fd);
            json_->write(report::monitor_begin_json(options.budget, options.clock));
        }
        thread_.emplace(kLookInterval, [this] { take_queued(); });
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() { close(); }

    void add(const MonitorRecord& record) {
        if (!queue_.try_push(record)) {
            lost_.fetch_add(1, std::memory_order_relaxed);
        }
    }

    void close() {
        if (!thread_) {
            return;
        }
        thread_.reset();
        panel_.reset();
        if (!json_) {
            return;
        }
        json_->finish(kLastPatience_ms);
        if (json_->broken()) {
            spdlog::warn("--monitor-json {}: {} ({} lines written, {} not)", *options_.json_fd,
                         json_->why_broken(), json_->written(), dropped());
        } else if (dropped() > 0) {
            spdlog::warn("--monitor-json {}: {} lines dropped, {} written: its reader was too slow",
                         *options_.json_fd, dropped(), json_->written());
        }
    }

  private:
    void take_queued() {
        while (const MonitorRecord* const record = queue_.front()) {
            if (const auto* const message = std::get_if<MonitorMessage>(record)) {
                take(*message);
            } else if (const auto* const event = std::get_if<MonitorEvent>(record); json_) {
                json_->write(report::monitor_event_json(event->time, event->kind.view(),
                                                        event->text.view(), dropped()));
            }
            queue_.pop();
        }
    }

    void take(const MonitorMessage& message) {
        const bool last = message.what == MonitorMessage::What::End;
        if (json_ && message.what != MonitorMessage::What::Picture) {
            json_->write(report::monitor_snapshot_json(last ? "end" : "interval", message.snapshot,
                                                       dropped()),
                         last ? kLastPatience_ms : 0);
        }
        const auto now = std::chrono::steady_clock::now();
        const bool due =
            now - last_shown_ >= (panel_ != nullptr ? kBetweenPictures : kBetweenLines);
        if (options_.panel && (due || last)) {
            last_shown_ = now;
            show(message.snapshot);
        }
    }

    void show(const latency::MonitorSnapshot& snapshot) {
        if (panel_ == nullptr) {
            const std::string text = report::monitor_line(snapshot, budget_) + "\n";
            std::fputs(text.c_str(), stderr);
            return;
        }
        const TerminalPanel::Size size = panel_->size();
        std::vector<std::string> lines;
        std::vector<int> columns;
        for (report::PanelLine& line :
             report::monitor_panel(snapshot, {.columns = size.columns,
                                              .rows = size.rows,
                                              .colour = TerminalPanel::wants_colour(),
                                              .budget = budget_})) {
            lines.push_back(std::move(line.text));
            columns.push_back(line.columns);
        }
        panel_->draw(lines, columns);
    }

    [[nodiscard]] std::uint64_t dropped() const {
        return json_->dropped() + lost_.load(std::memory_order_relaxed);
    }

    MonitorOutputOptions options_;
    std::string budget_;
    std::unique_ptr<TerminalPanel> panel_;  ///< none: nobody asked, or stderr is no terminal
    std::optional<LineWriter> json_;
    SpscQueue<MonitorRecord> queue_{kQueueRecords};
    std::atomic<std::uint64_t> lost_{0};
    std::chrono::steady_clock::time_point last_shown_;
    std::optional<PeriodicThread> thread_;  // the first to end
};

MonitorOutput::MonitorOutput(const MonitorOutputOptions& options)
    : impl_(std::make_unique<Impl>(options)) {}

MonitorOutput::~MonitorOutput() = default;

void MonitorOutput::add(const MonitorRecord& record) { impl_->add(record); }

void MonitorOutput::close() { impl_->close(); }

}  // namespace gazeloop::run
