#pragma once

#include <cstdint>
#include <functional>

namespace gazeloop::quality {

/// Shares rows among threads. Whoever sums keeps one sum per row and adds them up in their order
///, so that results are the same bits with any number of threads.
class RowWork {
  public:
    /// `threads` 0: as many as the machine has.
    explicit RowWork(unsigned threads = 0);

    /// Calls `work(from, to)` for ranges that cover [0, rows) once; returns when all are done.
    /// `work` runs on several threads at a time and must not throw.
    void over(std::uint32_t rows,
              const std::function<void(std::uint32_t from, std::uint32_t to)>& work) const;

    [[nodiscard]] unsigned threads() const { return threads_; }

  private:
    unsigned threads_;
};

}  // namespace gazeloop::quality
