#include "drivers/hid/feature_requests.h"

#include <pthread.h>

#include <utility>

namespace gazeloop::drivers::hid {
namespace {

constexpr const char* kThreadName = "gaze-hid-asks";

}  // namespace

FeatureRequests::FeatureRequests(HidrawDevice& device, StopRequested stop)
    : device_(device), stop_(std::move(stop)) {}

FeatureRequests::~FeatureRequests() { end(); }

void FeatureRequests::make(std::vector<Request> requests) {
    made_ = std::async(std::launch::async, [this, requests = std::move(requests)] {
        pthread_setname_np(pthread_self(), kThreadName);
        run(requests);
    });
}

bool FeatureRequests::done(std::chrono::milliseconds longest) {
    if (!made_.valid()) {
        return true;
    }
    if (made_.wait_for(longest) != std::future_status::ready) {
        return false;
    }
    made_.get();
    return true;
}

std::vector<FeatureRequests::Outcome> FeatureRequests::take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(outcomes_, {});
}

void FeatureRequests::end() {
    ending_ = true;
    if (made_.valid()) {
        made_.wait();
    }
}

void FeatureRequests::run(const std::vector<Request>& requests) {
    int unanswered = 0;
    for (const Request& request : requests) {
        if (ending_ || stop_()) {
            return;
        }
        Outcome outcome{.id = request.id, .sent = !request.sent.empty(), .answer = {}};
        if (unanswered >= kMostUnanswered) {
            outcome.answer = std::unexpected(RequestFailure{.why = RequestFailure::Why::NotMade});
        } else if (!outcome.sent) {
            outcome.answer = device_.feature(request.id, request.payload_bytes);
        } else if (const auto taken = device_.send_feature(request.sent); !taken) {
            outcome.answer = std::unexpected(taken.error());
        }
        if (!outcome.answer && outcome.answer.error().why == RequestFailure::Why::Unanswered) {
            ++unanswered;
        }
        const std::scoped_lock lock(mutex_);
        outcomes_.push_back(std::move(outcome));
    }
}

}  // namespace gazeloop::drivers::hid
