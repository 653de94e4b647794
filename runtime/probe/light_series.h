#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>

namespace gazeloop::probe {

/// What is looked at in each frame.
enum class Light : std::size_t { Lamp, Patch };
inline constexpr std::size_t kLightCount = 2;

/// The two lights' brightness in each frame, 0 .. 1. They lie in an unnamed temporary file, so that
/// the memory does not depend on the video's length.
class LightSeries {
  public:
    /// Throws SetupError (BadInput): no temporary file can be made.
    LightSeries();

    /// Throws SetupError (BadInput): the temporary file cannot be written.
    void add(float lamp, float patch);

    [[nodiscard]] std::size_t size() const { return size_; }
    /// Near accesses are cheap. Precondition: frame < size(). Throws SetupError (BadInput): the
    /// temporary file cannot be read.
    [[nodiscard]] double at(Light light, std::size_t frame) const;

  private:
    static constexpr std::size_t kBlock = 4096;
    using Pair = std::array<float, kLightCount>;

    void load(std::size_t block) const;

    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> file_;
    std::size_t size_ = 0;
    mutable std::size_t loaded_ = SIZE_MAX;  ///< block
    mutable std::array<Pair, kBlock> block_{};
};

}  // namespace gazeloop::probe
