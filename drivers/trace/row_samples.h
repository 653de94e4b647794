#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "drivers/trace/axes_change.h"
#include "drivers/trace/clock/kept_row.h"
#include "runtime/gaze/sample_range.h"
#include "runtime/memory/long_vector.h"
#include "runtime/memory/spool.h"

namespace gazeloop::drivers {

/// The samples that a file's rows are, once their clocks are judged: under a MemoryLimit put
/// together as they are read, not from two threads at once; without one at once, since they are
/// judged in several passes.
class RowSamples final : public gaze::SampleSource {
  public:
    /// Of each sample.
    struct Judged {
        memory::LongVector<std::size_t> rows;  ///< which one of the file it is
        memory::LongVector<std::uint64_t> numbers;
        memory::LongVector<std::int64_t> device_ns;
        memory::LongVector<std::int64_t> time_ns;
        memory::LongVector<std::optional<std::int64_t>> delay_ns;
        memory::LongVector<std::int64_t> step_ns;  ///< of a coarse clock; 0: fine
    };

    RowSamples(std::shared_ptr<const memory::Spool<KeptRow>> rows, Judged judged);

    [[nodiscard]] std::size_t size() const override { return size_; }
    void read(std::size_t first, std::span<gaze::GazeSample> to) const override;
    [[nodiscard]] std::vector<gaze::GazeSample> take() override;

    /// From now on.
    void change(const AxesChange& change) { change_ = change; }
    [[nodiscard]] const AxesChange& changed() const { return change_; }

  private:
    /// As the file has them.
    void put_together(std::size_t first, std::span<gaze::GazeSample> to) const;

    std::shared_ptr<const memory::Spool<KeptRow>> rows_;  ///< null: all are held
    mutable memory::SpoolReader<KeptRow> reader_;
    Judged judged_;
    std::size_t size_;
    std::vector<gaze::GazeSample> held_;  ///< as the file has them; empty under a limit
    AxesChange change_;
};

}  // namespace gazeloop::drivers
