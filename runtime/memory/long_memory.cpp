#include "runtime/memory/long_memory.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <bit>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <new>
#include <set>
#include <stop_token>
#include <thread>
#include <utility>

#include "runtime/error.h"
#include "runtime/memory/large_pages.h"
#include "runtime/memory/scratch_file.h"
#include "runtime/signals_blocked.h"

namespace gazeloop::memory {
namespace {

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

/// All long blocks of the process.
class Blocks {
  public:
    /// Lives as long as the process: vectors of static objects are released last.
    static Blocks& instance() {
        static Blocks* const blocks = new Blocks;
        return *blocks;
    }

    void* allocate(std::size_t bytes) {
        const std::scoped_lock lock(mutex_);
        if (limit_ == kNoLimit) {
            // As any vector's: what a growing one gives up is used again, without new faults.
            void* const block = ::operator new(bytes);
            counts_.in_memory += bytes;
            return block;
        }
        if (bytes <= limit_ && counts_.in_memory <= limit_ - bytes) {
            void* const block = mapped_memory(bytes);
            mapped_.insert(block);
            counts_.in_memory += bytes;
            return block;
        }
        void* const block = mapped_file(bytes);
        in_files_.emplace(block, bytes);
        counts_.in_files += bytes;
        any_in_file_.notify_one();
        return block;
    }

    /// Under the lock to the end: what stands there next is not to be let go of.
    void release(void* block, std::size_t bytes) {
        const std::scoped_lock lock(mutex_);
        const bool in_file = in_files_.erase(block) > 0;
        (in_file ? counts_.in_files : counts_.in_memory) -= bytes;
        if (in_file || mapped_.erase(block) > 0) {
            munmap(block, bytes);
        } else {
            ::operator delete(block, bytes);
        }
    }

    [[nodiscard]] LongBlocks counts() {
        const std::scoped_lock lock(mutex_);
        return counts_;
    }

    void limit(std::size_t bytes) {
        const std::scoped_lock lock(mutex_);
        limit_ = bytes;
        folder_in_memory_.clear();
    }

    [[nodiscard]] bool is_limited() {
        const std::scoped_lock lock(mutex_);
        return limit_ != kNoLimit;
    }

    void note(const ScratchFile& file) {
        const std::scoped_lock lock(mutex_);
        take_note(file);
    }

    [[nodiscard]] std::string folder_in_memory() {
        const std::scoped_lock lock(mutex_);
        return folder_in_memory_;
    }

    /// Lets go of the pages of scratch files, again and again: what is used next is mapped again,
    /// from the page cache. So what a pass over a long vector leaves behind is not the process's.
    void let_go_of_pages(const std::stop_token& stop) {
        constexpr std::chrono::milliseconds kPeriod{4};
        std::unique_lock lock(mutex_);
        while (any_in_file_.wait(lock, stop, [this] { return !in_files_.empty(); }) &&
               !stop.stop_requested()) {
            for (const auto& [block, bytes] : in_files_) {
                madvise(block, bytes, MADV_DONTNEED);
            }
            any_in_file_.wait_for(lock, stop, kPeriod, [] { return false; });
        }
    }

  private:
    static void* mapped_memory(std::size_t bytes) {
        void* const block =
            mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (block == MAP_FAILED) {
            throw std::bad_alloc();
        }
        advise_large_pages(block, bytes);
        return block;
    }

    void* mapped_file(std::size_t bytes) {
        ScratchFile file = value_or_throw(ScratchFile::make());
        void* const block = value_or_throw(file.map(bytes));
        take_note(file);
        return block;
    }

    void take_note(const ScratchFile& file) {
        if (std::string folder = file.in_memory(); !folder.empty()) {
            folder_in_memory_ = std::move(folder);
        }
    }

    std::mutex mutex_;
    std::condition_variable_any any_in_file_;
    std::size_t limit_ = kNoLimit;
    LongBlocks counts_;
    std::map<void*, std::size_t> in_files_;
    std::set<void*> mapped_;        ///< in memory, made under a limit
    std::string folder_in_memory_;  ///< of scratch files since the limit was set; empty: none
};

}  // namespace

void* allocate(std::size_t bytes) {
    return bytes < kLongBlock ? ::operator new(bytes) : Blocks::instance().allocate(bytes);
}

void release(void* block, std::size_t bytes) noexcept {
    if (bytes < kLongBlock) {
        ::operator delete(block, bytes);
    } else {
        Blocks::instance().release(block, bytes);
    }
}

MemoryLimit::MemoryLimit(std::size_t bytes) {
    Blocks::instance().limit(bytes);
    const SignalsBlocked blocked;
    keeper_ =
        std::jthread([](const std::stop_token& stop) { Blocks::instance().let_go_of_pages(stop); });
}

MemoryLimit::~MemoryLimit() { Blocks::instance().limit(kNoLimit); }

bool MemoryLimit::in_force() { return Blocks::instance().is_limited(); }

void MemoryLimit::note(const ScratchFile& file) { Blocks::instance().note(file); }

std::string MemoryLimit::doubt() const {
    const std::string folder = Blocks::instance().folder_in_memory();
    return folder.empty()
               ? folder
               : fmt::format(
                     "{}: is kept in memory itself, and so is a recording that is too long "
                     "for the rest of it: let TMPDIR name a folder on a disk",
                     folder);
}

LongBlocks long_blocks() { return Blocks::instance().counts(); }

}  // namespace gazeloop::memory
