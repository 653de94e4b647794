#pragma once

#include <umockdev.h>

#include <cstdint>
#include <deque>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace gazeloop::tests {

/// A PlayStation VR2 on a USB that this process and its children alone see: umockdev puts itself
/// between libusb and the kernel, and this answers in the kernel's and the headset's place,
/// transfer by transfer (linux/usbdevice_fs.h).
///
/// libusb waits until the node can be written to, which in usbfs says that a transfer has ended.
/// The node is a FIFO that is full while none has.
class EmulatedPsvr2 {
  public:
    /// HaltStays: its halted endpoint cannot be cleared. PulledOut: neither can it, and the node
    /// has gone when that is answered, as if the kernel had learnt of the unplugging in between.
    enum class Fault : int {
        None,
        ClaimedElsewhere,
        KernelDriver,
        RequestStalls,
        HaltStays,
        PulledOut,
        EventsFail,   ///< whether a transfer has ended cannot be asked
        NothingEnds,  ///< transfers that are discarded do not end
    };

    EmulatedPsvr2();
    EmulatedPsvr2(const EmulatedPsvr2&) = delete;
    EmulatedPsvr2& operator=(const EmulatedPsvr2&) = delete;
    ~EmulatedPsvr2();

    /// Whether the process runs under umockdev's preload library.
    [[nodiscard]] bool possible() const { return umockdev_in_mock_environment() != 0; }

    void plug_in();
    /// What is under way ends with an error, and the node goes.
    void unplug();
    /// Another one each time it is plugged in, from /dev/bus/usb/001/002.
    [[nodiscard]] std::string node() const;

    void set_fault(Fault fault);
    /// Whose it is and who may use it, of the node and of the folders above it.
    void set_mode(unsigned mode) const;

    /// Sends one bulk transfer, as soon as somebody listens.
    void send(std::span<const std::uint8_t> bytes);
    /// Halts its endpoint: what is under way and what follows ends with EPIPE until it is cleared.
    void halt();

    struct Seen {
        int claims = 0;
        int releases = 0;
        int starts = 0;  ///< requests for gaze
        int stops = 0;
        int others = 0;  ///< requests that it does not know
        int halts_cleared = 0;
        /// In this order: S asked to start, H halt cleared, R a transfer for data.
        std::string order;
        std::size_t listening = 0;      ///< bulk transfers under way
        std::vector<int> endpoints;     ///< that were read
        std::vector<unsigned> claimed;  ///< interfaces
    };
    [[nodiscard]] Seen seen() const;

  private:
    /// A transfer of the host's.
    struct Urb {
        UMockdevIoctlData* urb = nullptr;
        UMockdevIoctlData* buffer = nullptr;
    };

    static gboolean on_ioctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, gpointer self);
    // The following hold the mutex.
    void answer(UMockdevIoctlClient* client);
    void submit(UMockdevIoctlClient* client);
    void reap(UMockdevIoctlClient* client);
    void discard(UMockdevIoctlClient* client);
    void take_request(const Urb& urb);
    void finish(const Urb& urb, int status, int actual_length);
    void deliver();
    void show_whether_any_has_ended() const;
    void forget(std::deque<Urb>& urbs);

    UMockdevTestbed* testbed_;
    UMockdevIoctlBase* handler_;
    mutable std::mutex mutex_;
    int device_number_ = 1;
    std::string root_;
    int fifo_ = -1;
    Fault fault_ = Fault::None;
    bool halted_ = false;
    bool gone_ = true;
    std::deque<Urb> waiting_;  ///< for data
    std::deque<Urb> ended_;
    std::deque<std::vector<std::uint8_t>> to_send_;
    Seen seen_;
};

}  // namespace gazeloop::tests
