#include "runtime/latency/sample_counter.h"

#include <algorithm>
#include <utility>

#include "runtime/time/span.h"

namespace gazeloop::latency {

void SampleCounter::add(const gaze::GazeSample& sample) {
    const bool first = counts_.received++ == 0;
    if (!sample.eyes[0].valid && !sample.eyes[1].valid) {
        ++counts_.invalid;
    }
    const time::Stamp sampled_before = std::exchange(last_sampled_, sample.sampled);
    const std::uint64_t highest_before =
        std::exchange(highest_sequence_, std::max(highest_sequence_, sample.sequence));
    if (first) {
        return;
    }
    if (sample.sequence <= highest_before || time::goes_back(sampled_before, sample.sampled)) {
        ++counts_.out_of_order;
    }
    if (sample.sequence > highest_before) {
        counts_.lost += sample.sequence - highest_before - 1;
    } else if (sample.sequence < highest_before && counts_.lost > 0) {
        --counts_.lost;  // taken for lost when a later one came first
    }
}

}  // namespace gazeloop::latency
