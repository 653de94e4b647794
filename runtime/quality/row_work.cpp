#include "runtime/quality/row_work.h"

#include <algorithm>
#include <thread>
#include <vector>

namespace gazeloop::quality {
namespace {

constexpr unsigned kMostThreads = 64;
/// Fewer rows than this per thread are not worth starting one.
constexpr std::uint32_t kLeastRows = 32;

}  // namespace

RowWork::RowWork(unsigned threads)
    : threads_(std::clamp(threads == 0 ? std::thread::hardware_concurrency() : threads, 1U,
                          kMostThreads)) {}

void RowWork::over(std::uint32_t rows,
                   const std::function<void(std::uint32_t, std::uint32_t)>& work) const {
    const std::uint32_t parts = std::clamp(rows / kLeastRows, 1U, threads_);
    const auto begin_of = [&](std::uint32_t part) {
        return static_cast<std::uint32_t>(std::uint64_t{rows} * part / parts);
    };
    std::vector<std::jthread> others;
    others.reserve(parts - 1);
    for (std::uint32_t part = 1; part < parts; ++part) {
        others.emplace_back([&, part] { work(begin_of(part), begin_of(part + 1)); });
    }
    work(0, begin_of(1));
}

}  // namespace gazeloop::quality
