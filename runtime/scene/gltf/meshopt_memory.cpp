#include "runtime/scene/gltf/meshopt_memory.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <functional>
#include <new>

namespace gazeloop::scene::gltf {
namespace {

/// A shape that needs more takes and gives back what is beyond it.
constexpr std::size_t kMostKept = std::size_t{64} << 20U;
constexpr std::size_t kAlignment = 64;

thread_local MeshoptMemory* memory_of_thread = nullptr;

void* allocate(std::size_t bytes) {
    if (memory_of_thread != nullptr) {
        if (void* const taken = memory_of_thread->take(bytes)) {
            return taken;
        }
    }
    void* const block = ::operator new(bytes);
    memory::advise_large_pages(block, bytes);
    return block;
}

void deallocate(void* block) {
    if (memory_of_thread == nullptr || !memory_of_thread->give_back(block)) {
        ::operator delete(block);
    }
}

}  // namespace

MeshoptMemory::MeshoptMemory() {
    static const bool is_set = [] {
        meshopt_setAllocator(allocate, deallocate);
        return true;
    }();
    static_cast<void>(is_set);
    memory_of_thread = this;
}

MeshoptMemory::~MeshoptMemory() { memory_of_thread = nullptr; }

void* MeshoptMemory::take(std::size_t bytes) {
    if (open_ == 0) {
        asked_bytes_ = 0;
        if (most_bytes_ > block_.size()) {
            block_ = {};
            block_.resize((most_bytes_ + memory::kLargePage - 1) / memory::kLargePage *
                          memory::kLargePage);
        }
    }
    ++open_;
    if (bytes > kMostKept) {
        return nullptr;
    }
    const std::size_t rounded = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    asked_bytes_ += rounded;
    most_bytes_ = std::clamp(asked_bytes_, most_bytes_, kMostKept);
    if (rounded > block_.size() - taken_bytes_) {
        return nullptr;
    }
    void* const at = block_.data() + taken_bytes_;
    taken_bytes_ += rounded;
    return at;
}

bool MeshoptMemory::give_back(const void* taken) noexcept {
    --open_;
    const auto* const at = static_cast<const std::byte*>(taken);
    if (std::less<>()(at, block_.data()) || !std::less<>()(at, block_.data() + block_.size())) {
        return false;
    }
    taken_bytes_ = static_cast<std::size_t>(at - block_.data());
    return true;
}

}  // namespace gazeloop::scene::gltf
