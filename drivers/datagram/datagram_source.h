#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/datagram/osc_gaze.h"
#include "drivers/gaze_source.h"
#include "runtime/error.h"

namespace gazeloop::drivers::datagram {

/// Where datagrams are listened for. By default from this machine alone.
struct Endpoint {
    std::string address = "127.0.0.1";  ///< IPv4
    std::uint16_t port = 0;
};

/// "PORT" or "ADDRESS:PORT". Errors (Usage): neither.
Expected<Endpoint> parse_endpoint(std::string_view text);

/// Gaze of home-made trackers: OSC in UDP datagrams. Each is a sample; when it arrived the kernel
/// says, when the eye was seen nobody.
class DatagramSource final : public GazeSource {
  public:
    /// Larger ones are no gaze, and counted as damaged.
    static constexpr std::size_t kLargest = 2048;
    /// Taken in one poll(), so that a flood holds nothing up; the kernel drops what is too much.
    static constexpr int kMostAtOnce = 1024;

    /// Throws SetupError (NoDevice) where the port cannot be had.
    explicit DatagramSource(const Endpoint& endpoint);
    ~DatagramSource() override;
    DatagramSource(const DatagramSource&) = delete;
    DatagramSource& operator=(const DatagramSource&) = delete;

    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override;
    [[nodiscard]] std::vector<SourceEvent> take_events() override;
    [[nodiscard]] std::string description() const override;

  private:
    Endpoint endpoint_;
    int socket_;
    OscGaze gaze_;
    std::array<std::uint8_t, kLargest> packet_{};
    bool told_first_ = false;
    bool told_other_ = false;
    std::uint64_t damaged_told_ = 0;
    std::vector<SourceEvent> events_;
};

}  // namespace gazeloop::drivers::datagram
