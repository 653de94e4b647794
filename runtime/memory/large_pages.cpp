#include "runtime/memory/large_pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <bit>
#include <cstdint>

namespace gazeloop::memory {

void advise_large_pages(const void* begin, std::size_t bytes) noexcept {
    /// Shorter ones save little, and each can cost the process a mapping, of which there are few.
    constexpr std::size_t kFewestBytes = std::size_t{1} << 20U;
    if (bytes < kFewestBytes) {
        return;
    }
    static const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto at = std::bit_cast<std::uintptr_t>(begin);
    const std::uintptr_t first = at / page * page;
    const std::uintptr_t last = (at + bytes + page - 1) / page * page;
    madvise(std::bit_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

}  // namespace gazeloop::memory
