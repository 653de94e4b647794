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

/// Values that are added one by one, and read again from any place. Under a MemoryLimit the last
/// kBuffered of them are in memory, those before in a scratch file; without one all stay in memory,
/// which is twice as fast. Reading and adding throw SetupError where the file fails.
template <typename Value>
    requires std::is_trivially_copyable_v<Value>
class Spool {
  public:
    static constexpr std::size_t kBuffered = 4096;

    void add(const Value& value) {
        if (last_.size() == kBuffered) {
            if (may_file()) {
                value_or_throw(
                    file_->write(filed_ * sizeof(Value), std::as_bytes(std::span(last_))));
                last_.clear();
            } else {
                full_.push_back(std::move(last_));
                last_ = {};
                last_.reserve(kBuffered);
            }
            filed_ += kBuffered;
        }
        last_.push_back(value);
    }

    [[nodiscard]] std::size_t size() const { return filed_ + last_.size(); }

    /// Precondition: first + to.size() <= size().
    void read(std::size_t first, std::span<Value> to) const {
        const std::size_t of_file = std::min(to.size(), filed_ - std::min(first, filed_));
        if (of_file > 0 && limited_) {
            value_or_throw(
                file_->read(first * sizeof(Value), std::as_writable_bytes(to.first(of_file))));
        } else {
            for (std::size_t done = 0; done < of_file;) {
                const std::size_t at = first + done;
                const std::size_t within = at % kBuffered;
                const std::size_t count = std::min(of_file - done, kBuffered - within);
                std::copy_n(full_[at / kBuffered].begin() + static_cast<std::ptrdiff_t>(within),
                            count, to.begin() + static_cast<std::ptrdiff_t>(done));
                done += count;
            }
        }
        const std::size_t from = first + of_file - filed_;
        std::copy_n(last_.begin() + static_cast<std::ptrdiff_t>(from), to.size() - of_file,
                    to.begin() + static_cast<std::ptrdiff_t>(of_file));
    }

  private:
    /// Whether there is a file; makes it when it is asked for first.
    bool may_file() {
        if (!file_ && limited_) {
            file_ = value_or_throw(ScratchFile::make());
            MemoryLimit::note(*file_);
        }
        return limited_;
    }

    bool limited_ = MemoryLimit::in_force();  ///< as it was made
    std::optional<ScratchFile> file_;
    std::size_t filed_ = 0;                 ///< values before the last ones
    std::vector<std::vector<Value>> full_;  ///< those, without a limit
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
