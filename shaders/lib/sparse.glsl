// Sparse sampling: a list of samples, and where each lies in the picture (foveation::SparsePlan).
layout(std430, set = 2, binding = 1) readonly buffer SparseTable { int sparse_table[]; };
layout(std430, set = 2, binding = 2) readonly buffer SparsePattern { uint sparse_pattern[]; };

const int kListWidth = 512;    // SparsePlan::kListWidth
const int kSparseHeader = 7;   // SparsePlan::kHeader

int list_length() { return sparse_table[0]; }
int list_rows() { return sparse_table[1]; }
int first_list_row() { return sparse_table[2]; }
ivec2 pattern_origin() { return ivec2(sparse_table[3], sparse_table[4]); }
ivec2 pattern_sign() { return ivec2(sparse_table[5], sparse_table[6]); }

// Samples in the rows before this one, and the index of its first.
ivec2 pattern_row(int row) {
    return ivec2(sparse_table[kSparseHeader + 2 * row], sparse_table[kSparseHeader + 2 * row + 1]);
}

ivec2 place_in_pattern(int sample_index) {
    uint packed = sparse_pattern[sample_index];
    return ivec2(packed & 0xffffu, packed >> 16u);
}

// The pixel of the picture, or beyond it, at a place of the pattern.
ivec2 pixel_of_place(ivec2 place) { return pattern_sign() * (place - pattern_origin()); }
