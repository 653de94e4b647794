#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/psvr2/headset.h"
#include "drivers/psvr2/stream_keeper.h"

struct libusb_context;
struct libusb_device_handle;
struct libusb_transfer;

namespace gazeloop::drivers::psvr2 {

/// A libusb context of its own, which knows what is plugged in at the moment it is made.
class UsbContext {
  public:
    [[nodiscard]] static Expected<UsbContext> create();
    [[nodiscard]] libusb_context* get() const { return context_.get(); }

  private:
    struct Exit {
        void operator()(libusb_context* context) const;
    };
    explicit UsbContext(libusb_context* context) : context_(context) {}

    std::unique_ptr<libusb_context, Exit> context_;
};

/// A device that was opened, and whose gaze interface is claimed as long as this lives.
class UsbHandle {
  public:
    /// Errors (NoDevice): as open_headset().
    [[nodiscard]] static Expected<UsbHandle> open(const UsbContext& context,
                                                  const FoundDevice& found);
    [[nodiscard]] libusb_device_handle* get() const { return handle_.get(); }
    [[nodiscard]] std::uint8_t endpoint() const { return endpoint_; }

  private:
    struct Close {
        void operator()(libusb_device_handle* handle) const;
    };
    UsbHandle(libusb_device_handle* handle, std::uint8_t endpoint)
        : handle_(handle), endpoint_(endpoint) {}

    std::unique_ptr<libusb_device_handle, Close> handle_;
    std::uint8_t endpoint_;
};

/// A headset that is being read (open_headset). All work happens in read(), on the caller's thread.
/// The destructor takes 2 s at most: transfers that have not ended by then are left as they are.
class UsbHeadset final : public TrackerDevice {
  public:
    /// Throws std::bad_alloc.
    UsbHeadset(UsbContext context, UsbHandle handle, const FoundDevice& found,
               const Psvr2Options& options);
    UsbHeadset(const UsbHeadset&) = delete;
    UsbHeadset& operator=(const UsbHeadset&) = delete;
    ~UsbHeadset() override;

    [[nodiscard]] const std::string& text() const override { return text_; }
    [[nodiscard]] const std::vector<std::string>& remarks() const override { return remarks_; }
    [[nodiscard]] Expected<void> read(std::chrono::milliseconds longest, DeviceFeed& feed) override;
    [[nodiscard]] TrackerCounts counts() const override { return samples_.counts(); }
    [[nodiscard]] std::string_view why_silent() const override {
        return "it may be asleep or not worn, or another program may have stopped its gaze stream";
    }
    [[nodiscard]] PupilsMm pupils_mm() const override { return samples_.pupils_mm(); }
    [[nodiscard]] const time::ClockFit* clock() const override { return samples_.clock(); }

  private:
    static constexpr std::size_t kTransfers = 4;
    /// A multiple of the USB packet size, and more than a gaze packet, so that one that is too long
    /// is noticed.
    static constexpr std::size_t kTransferBytes = 4096;
    static constexpr std::size_t kRequestBytes = 8;

    enum class Asking : std::uint8_t { Start = 1, Stop = 2 };

    /// One libusb transfer and its memory, which stays where it is.
    struct Transfer {
        struct Free {
            void operator()(libusb_transfer* transfer) const;
        };
        UsbHeadset* owner = nullptr;
        std::unique_ptr<libusb_transfer, Free> transfer;
        std::array<std::uint8_t, kTransferBytes> bytes{};
        bool under_way = false;
        Transfer* left_before = nullptr;  ///< see leave_what_is_under_way()
    };

    [[nodiscard]] std::unique_ptr<Transfer> new_transfer();
    static void on_data(libusb_transfer* transfer);
    static void on_asked(libusb_transfer* transfer);
    void take(Transfer& transfer, std::int64_t arrived_ns);
    void submit(Transfer& transfer);
    void submit_all();
    void cancel_all();
    [[nodiscard]] bool any_under_way() const;  ///< of those for data
    /// Waits until no transfer is under way; false where that takes too long or cannot be waited
    /// for.
    [[nodiscard]] bool end_all(std::int64_t until_ns);
    void leave_what_is_under_way();
    void ask(Asking what, std::int64_t now_ns);
    void keep_alive(std::int64_t now_ns);
    void recover();
    void note(int result, std::string_view doing);
    void tell_loss();
    [[nodiscard]] std::optional<std::string> why_over(std::int64_t now_ns);
    /// False where libusb cannot wait for this device any more.
    bool wait(std::chrono::microseconds longest);

    std::string text_;
    std::string path_;
    std::vector<std::string> remarks_;
    UsbContext context_;
    UsbHandle handle_;
    GazeSamples samples_;
    StreamKeeper keeper_;
    std::array<std::unique_ptr<Transfer>, kTransfers> data_;
    std::unique_ptr<Transfer> request_;

    DeviceFeed* feed_ = nullptr;  ///< of the read() that runs
    bool halted_ = false;         ///< what is under way has to end first
    bool gone_ = false;
    std::string failure_;
    std::optional<std::int64_t> failed_ns_;
    int failures_in_a_row_ = 0;
    bool told_silent_ = false;
    bool told_refused_ = false;
};

}  // namespace gazeloop::drivers::psvr2
