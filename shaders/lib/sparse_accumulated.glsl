// What sparse sampling accumulates: radiance and, in one channel, the weight behind it and its
// nearness. Whole steps are the weight (at most 20, which is the sum of 1 kept by .95), the fraction
// is nearness.
const float kWeightSteps = 100.0;

float accumulated_channel(float weight, float nearness) {
    return floor(clamp(weight, 0.0, 20.0) * kWeightSteps) + 0.99 * nearness / (1.0 + nearness);
}

float accumulated_weight(float channel) { return floor(channel) / kWeightSteps; }

float accumulated_nearness(float channel) {
    float share = min(fract(channel) / 0.99, 0.999);
    return share / (1.0 - share);
}
