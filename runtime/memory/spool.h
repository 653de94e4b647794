#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "runtime/error.h"
#include "runtime/memory/long_memory.h"
#include "runtime/memory/scratch_file.h"

namespace gazeloop::memory {

/// Values that are added one by one, and read again from any place: the last kBuffered of them in
/// memory, those before in a scratch file. Without a MemoryLimit they stay in memory where there
/// can be no such file. Reading and adding throw SetupError where the file fails.
template <typename Value>
    requires std::is_trivially_copyable_v<Value>
class Spool {
  public:
    static constexpr std::size_t kBuffered = 4096;

    void add(const Value& value) {
        if (last_.size() >= kBuffered && may_file()) {
            value_or_throw(file_->write(filed_ * sizeof(Value), std::as_bytes(std::span(last_))));
            filed_ += last_.size();
            last_.clear();
        }
        last_.push_back(value);
    }

    [[nodiscard]] std::size_t size() const { return filed_ + last_.size(); }

    /// Precondition: first + to.size() <= size().
    void read(std::size_t first, std::span<Value> to) const {
        const std::size_t of_file = std::min(to.size(), filed_ - std::min(first, filed_));
        if (of_file > 0) {
            value_or_throw(
                file_->read(first * sizeof(Value), std::as_writable_bytes(to.first(of_file))));
        }
        const std::size_t from = first + of_file - filed_;
        std::copy_n(last_.begin() + static_cast<std::ptrdiff_t>(from), to.size() - of_file,
                    to.begin() + static_cast<std::ptrdiff_t>(of_file));
    }

  private:
    /// Whether there is a file; makes it when it is asked for first.
    bool may_file() {
        if (!file_ && !refused_) {
            Expected<ScratchFile> made = ScratchFile::make();
            refused_ = !made && !MemoryLimit::in_force();
            if (!refused_) {
                file_ = value_or_throw(std::move(made));
                MemoryLimit::note(*file_);
            }
        }
        return file_.has_value();
    }

    std::optional<ScratchFile> file_;
    bool refused_ = false;
    std::size_t filed_ = 0;  ///< values
    std::vector<Value> last_;
};

/// Reads single values of a spool that nobody adds to meanwhile, in blocks: two places at a time
/// may be read on from.
template <typename Value>
class SpoolReader {
  public:
    explicit SpoolReader(const Spool<Value>& spool) : spool_(&spool) {}

    /// Until the next but one call.
    [[nodiscard]] const Value& operator[](std::size_t i) {
        const std::size_t block = i / kBlock;
        if (blocks_[latest_].number != block) {
            latest_ = 1 - latest_;
            if (blocks_[latest_].number != block) {
                load(block);
            }
        }
        return blocks_[latest_].values[i % kBlock];
    }

  private:
    static constexpr std::size_t kBlock = 512;
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    struct Block {
        std::size_t number = kNone;
        std::vector<Value> values;
    };

    void load(std::size_t number) {
        Block& block = blocks_[latest_];
        block.values.resize(std::min(kBlock, spool_->size() - number * kBlock));
        spool_->read(number * kBlock, block.values);
        block.number = number;
    }

    const Spool<Value>* spool_;
    std::array<Block, 2> blocks_;
    std::size_t latest_ = 0;
};

}  // namespace gazeloop::memory
