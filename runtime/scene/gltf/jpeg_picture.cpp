#include "runtime/scene/gltf/jpeg_picture.h"

#include <fmt/format.h>

#include <array>
#include <csetjmp>
#include <cstdio>
// libjpeg's own header needs FILE and size_t before it.
#include <jpeglib.h>

namespace gazeloop::scene::gltf {
namespace {

/// More than encoders write (about 10); each is a pass over the whole picture.
constexpr int kMostScans = 100;

struct JpegErrors {
    jpeg_error_mgr manager{};  // first, so that libjpeg's pointer to it is one to this
    std::jmp_buf where{};
    std::array<char, JMSG_LENGTH_MAX> complaint{};
};

JpegErrors& errors_of(j_common_ptr jpeg) { return *reinterpret_cast<JpegErrors*>(jpeg->err); }

[[noreturn]] void leave(j_common_ptr jpeg) {
    (*jpeg->err->format_message)(jpeg, errors_of(jpeg).complaint.data());
    std::longjmp(errors_of(jpeg).where, 1);
}

void count_warning(j_common_ptr jpeg, int level) {
    if (level < 0) {
        if (jpeg->err->num_warnings++ == 0) {
            (*jpeg->err->format_message)(jpeg, errors_of(jpeg).complaint.data());
        }
    }
}

void stop_endless(j_common_ptr jpeg) {
    if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number > kMostScans) {
        std::snprintf(errors_of(jpeg).complaint.data(), JMSG_LENGTH_MAX, "more than %d scans",
                      kMostScans);
        std::longjmp(errors_of(jpeg).where, 1);
    }
}

void prepare(jpeg_decompress_struct& jpeg, JpegErrors& errors, std::span<const std::byte> bytes) {
    jpeg.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = leave;
    errors.manager.emit_message = count_warning;
    jpeg_create_decompress(&jpeg);
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
}

// Plain types alone in both, since libjpeg jumps out of them. False: errors.complaint says why.

bool read_header(std::span<const std::byte> bytes, JpegErrors& errors, PictureHeader& header) {
    jpeg_decompress_struct jpeg{};
    if (setjmp(errors.where) != 0) {
        jpeg_destroy_decompress(&jpeg);
        return false;
    }
    prepare(jpeg, errors, bytes);
    jpeg_read_header(&jpeg, TRUE);
    header.kind = PictureKind::Jpeg;
    header.width = jpeg.image_width;
    header.height = jpeg.image_height;
    const bool is_print = jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK;
    if (is_print) {
        std::snprintf(errors.complaint.data(), JMSG_LENGTH_MAX, "its colours are CMYK");
    }
    jpeg_destroy_decompress(&jpeg);
    return !is_print;
}

bool read_rows(std::span<const std::byte> bytes, JpegErrors& errors, std::byte* to,
               std::size_t row_bytes) {
    jpeg_decompress_struct jpeg{};
    jpeg_progress_mgr progress{};
    if (setjmp(errors.where) != 0) {
        jpeg_destroy_decompress(&jpeg);
        return false;
    }
    prepare(jpeg, errors, bytes);
    progress.progress_monitor = stop_endless;
    jpeg.progress = &progress;
    jpeg_read_header(&jpeg, TRUE);
    jpeg.out_color_space = JCS_EXT_RGBA;
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = reinterpret_cast<JSAMPROW>(to + jpeg.output_scanline * row_bytes);
        jpeg_read_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_decompress(&jpeg);
    jpeg_destroy_decompress(&jpeg);
    return true;
}

}  // namespace

PictureHeader read_jpeg_header(std::span<const std::byte> bytes, const std::string& place) {
    JpegErrors errors;
    PictureHeader header;
    if (!read_header(bytes, errors, header)) {
        refuse(place,
               fmt::format("is a JPEG that cannot be decoded ({})", errors.complaint.data()));
    }
    return header;
}

void decode_jpeg(std::span<const std::byte> bytes, const std::string& place, mesh::Image& image,
                 Notes& notes) {
    JpegErrors errors;
    if (!read_rows(bytes, errors, image.texels.data(), image.texels.size() / image.height)) {
        refuse(place,
               fmt::format("is a JPEG that cannot be decoded ({})", errors.complaint.data()));
    }
    if (errors.manager.num_warnings > 0) {
        notes.add("damaged picture", place,
                  fmt::format("is a damaged JPEG ({}): shown as far as it goes",
                              errors.complaint.data()));
    }
}

}  // namespace gazeloop::scene::gltf
