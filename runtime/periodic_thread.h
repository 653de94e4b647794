#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

#include "runtime/signals_blocked.h"

namespace gazeloop {

/// Does something again and again on a thread of its own, which takes no signals: a period after it
/// was done last, and once more when it ends. It sleeps by itself, so that nobody has to wake it
/// for what is not urgent.
class PeriodicThread {
  public:
    /// `work` must not throw. Throws std::system_error where the system has no thread left.
    PeriodicThread(std::chrono::milliseconds period, std::function<void()> work)
        : period_(period), work_(std::move(work)) {
        const SignalsBlocked blocked;
        thread_ = std::thread([this] { run(); });
    }
    PeriodicThread(const PeriodicThread&) = delete;
    PeriodicThread& operator=(const PeriodicThread&) = delete;
    ~PeriodicThread() { stop(); }

    /// After the last work. Idempotent; by one thread, and not from `work`.
    void stop() {
        if (!thread_.joinable()) {
            return;
        }
        {
            const std::lock_guard lock(mutex_);
            stopping_ = true;
        }
        wake_.notify_one();
        thread_.join();
    }

  private:
    void run() {
        for (bool last = false; !last;) {
            {
                std::unique_lock lock(mutex_);
                wake_.wait_for(lock, period_, [this] { return stopping_; });
                last = stopping_;
            }
            work_();
        }
    }

    std::chrono::milliseconds period_;
    std::function<void()> work_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool stopping_ = false;
    std::thread thread_;
};

}  // namespace gazeloop
