#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gazeloop::run {

/// Writes lines to a file descriptor that somebody else has opened, a pipe or socket above all, and
/// never waits for its reader: a line that finds no room is dropped and counted. A line is written
/// whole or not at all, but for the last one before a reader goes away. The descriptor is not
/// closed, and no flag is changed that others who have it would see.
class LineWriter {
  public:
    /// Why nothing can be written there: not open, or for reading only. Empty: it can. To be asked
    /// before the program opens files of its own, which take free numbers.
    [[nodiscard]] static std::string refusal(int fd);
    /// The same of a descriptor's number as text.
    [[nodiscard]] static std::string refusal(std::string_view text);

    /// The descriptor is kept from programs that this one starts.
    explicit LineWriter(int fd);

    /// A line without its end; waits at most so many milliseconds for room. False: it was dropped.
    bool write(std::string_view line, int patience_ms = 0);

    /// Waits for room for what has been begun, at most so many milliseconds in all.
    void finish(int patience_ms);

    [[nodiscard]] std::uint64_t written() const { return written_; }
    [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
    /// Whether nothing can be written any more: the reader has gone, or the disk is full.
    [[nodiscard]] bool broken() const { return !why_broken_.empty(); }
    [[nodiscard]] const std::string& why_broken() const { return why_broken_; }

  private:
    /// Writes what there is room for of the rest.
    void go_on(int patience_ms);

    int fd_;
    std::string rest_;  ///< of a line that has been begun
    std::uint64_t written_ = 0;
    std::uint64_t dropped_ = 0;
    std::string why_broken_;
};

}  // namespace gazeloop::run
