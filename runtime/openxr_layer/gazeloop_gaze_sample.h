/* XR_GAZELOOP_gaze_sample, revision 1: the tracker's own sample behind a located eye gaze.
 * See the layer's documentation (XR_GAZELOOP_gaze_sample.md). Provisional: not in the registry.
 */
#ifndef GAZELOOP_GAZE_SAMPLE_H
#define GAZELOOP_GAZE_SAMPLE_H 1

#include <openxr/openxr.h>

#ifdef __cplusplus
extern "C" {
#endif

#define XR_GAZELOOP_gaze_sample 1
#define XR_GAZELOOP_gaze_sample_SPEC_VERSION 1
#define XR_GAZELOOP_GAZE_SAMPLE_EXTENSION_NAME "XR_GAZELOOP_gaze_sample"

#define XR_TYPE_GAZE_SAMPLE_GAZELOOP ((XrStructureType)1900000000)

/* A header for C too. NOLINTBEGIN(modernize-use-using) */

typedef enum XrGazeProcessingGAZELOOP {
    XR_GAZE_PROCESSING_UNKNOWN_GAZELOOP = 0,
    XR_GAZE_PROCESSING_RAW_GAZELOOP = 1,
    XR_GAZE_PROCESSING_FUSED_GAZELOOP = 2,
    XR_GAZE_PROCESSING_FILTERED_GAZELOOP = 3,
    XR_GAZE_PROCESSING_MAX_ENUM_GAZELOOP = 0x7FFFFFFF
} XrGazeProcessingGAZELOOP;

typedef enum XrGazeEventGAZELOOP {
    XR_GAZE_EVENT_UNKNOWN_GAZELOOP = 0,
    XR_GAZE_EVENT_FIXATION_GAZELOOP = 1,
    XR_GAZE_EVENT_SACCADE_GAZELOOP = 2,
    XR_GAZE_EVENT_OSCILLATION_GAZELOOP = 3,
    XR_GAZE_EVENT_PURSUIT_GAZELOOP = 4,
    XR_GAZE_EVENT_LOST_GAZELOOP = 5,
    XR_GAZE_EVENT_MAX_ENUM_GAZELOOP = 0x7FFFFFFF
} XrGazeEventGAZELOOP;

/* One eye, in the VIEW space of the sample's time: +X right, +Y up, -Z forward. */
typedef struct XrGazeSampleEyeGAZELOOP {
    XrBool32 isValid;       /* the tracker vouches for the direction */
    XrBool32 hasCovariance; /* it states the direction's error */
    XrVector3f origin;      /* metres; zero where the tracker has none */
    XrVector3f direction;   /* unit vector; meaningful if isValid */
    float openness;         /* 0 closed .. 1 open, -1 unknown */
    float confidence;       /* 0 .. 1, -1 unknown */
    float covariance[3];    /* rad^2: across, across by up, up; meaningful if hasCovariance */
} XrGazeSampleEyeGAZELOOP;

/* Chained to XrSpaceLocation at xrLocateSpace of an eye gaze space. */
typedef struct XrGazeSampleGAZELOOP {
    XrStructureType type;
    void* XR_MAY_ALIAS next;
    XrBool32 isAvailable;   /* else what follows is zero */
    XrTime sampleTime;      /* when the eyes were seen; 0: unknown */
    XrDuration uncertainty; /* of sampleTime, either way; -1: unknown */
    XrTime arrivalTime;     /* when the host had the sample; 0: unknown */
    uint64_t sequence;      /* counts up by one for each report of the tracker */
    XrGazeProcessingGAZELOOP processing;
    XrGazeEventGAZELOOP event;       /* what the eyes do at this sample */
    XrGazeSampleEyeGAZELOOP eyes[2]; /* left, right */
} XrGazeSampleGAZELOOP;

/* NOLINTEND(modernize-use-using) */

#ifdef __cplusplus
}
#endif

#endif
