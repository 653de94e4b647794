#pragma once

#include <umockdev.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gazeloop::tests {

/// A /dev/hidrawN that this process alone sees (umockdev), for programs under its preload library.
/// The node is a FIFO of packets, because umockdev's own terminal would merge reports.
class EmulatedTracker {
  public:
    /// How reads of the device and requests for its features go.
    enum class Fault : int { None, ReadFails, FeaturesStall };

    explicit EmulatedTracker(std::vector<std::uint8_t> descriptor);
    EmulatedTracker(const EmulatedTracker&) = delete;
    EmulatedTracker& operator=(const EmulatedTracker&) = delete;
    ~EmulatedTracker();

    /// Whether the process runs under umockdev's preload library; it knows once there is a testbed.
    [[nodiscard]] bool possible() const { return umockdev_in_mock_environment() != 0; }

    void plug_in();
    /// The node goes, and what has it open cannot read it any more.
    void unplug();

    void set_feature(std::uint8_t id, std::vector<std::uint8_t> report);
    /// No request for, or of, this feature report is answered any more: the kernel, that is this,
    /// gives up after so long.
    void leave_unanswered(std::uint8_t id, std::chrono::milliseconds given_up_after);
    /// The feature report that was last sent to the device.
    [[nodiscard]] std::optional<std::vector<std::uint8_t>> sent(std::uint8_t id) const;

    /// How many feature reports were sent to it, and taken.
    [[nodiscard]] int requests_taken() const;
    /// How many feature reports it was asked for.
    [[nodiscard]] int asked() const;

    /// False where as many reports wait to be read as the FIFO holds.
    [[nodiscard]] bool try_send(std::span<const std::uint8_t> report) const;
    /// Waits until there is room; throws after 10 s without.
    void send(std::span<const std::uint8_t> report) const;
    void set_fault(Fault fault);
    void set_mode(unsigned mode) const;
    /// /dev/NAME is another name of /dev/TARGET from here on, as udev makes them.
    void set_link(const std::string& name, const std::string& target) const;
    /// Another number each time it is plugged in, from 0.
    [[nodiscard]] std::string node() const;

  private:
    static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
    static gboolean on_read(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
    bool answer(UMockdevIoctlClient* client);
    void wake_reader() const;
    [[nodiscard]] std::string hidraw_syspath() const;

    std::vector<std::uint8_t> descriptor_;
    UMockdevTestbed* testbed_;
    UMockdevIoctlBase* handler_;
    int plugged_ = 0;
    std::string real_node_;
    int fifo_ = -1;
    std::atomic<Fault> fault_{Fault::None};
    mutable std::mutex mutex_;
    std::map<std::uint8_t, std::vector<std::uint8_t>> features_;
    std::map<std::uint8_t, std::vector<std::uint8_t>> sent_;
    std::map<std::uint8_t, std::chrono::milliseconds> unanswered_;  ///< and when it is given up
    int asked_ = 0;
    int taken_ = 0;
};

}  // namespace gazeloop::tests
