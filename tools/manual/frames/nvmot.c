/* What the loop over a batch stands in: those of nvdstracker.h's types and fields that it uses. */
#include <stdbool.h>
#include <stdint.h>

#include "gentrack2.h"

typedef struct {
    float x, y, width, height;
} NvMOTRect;
typedef struct {
    uint16_t classId;
    NvMOTRect bbox;
    float confidence;
    bool doTracking;
} NvMOTObjToTrack;
typedef struct {
    bool detectionDone;
    NvMOTObjToTrack *list;
    uint32_t numAllocated, numFilled;
} NvMOTObjToTrackList;
typedef uint64_t NvMOTStreamId;
typedef struct {
    NvMOTStreamId streamID;
    bool doTracking, reset;
    NvMOTObjToTrackList objectsIn;
} NvMOTFrame;
typedef struct {
    uint16_t classId;
    uint64_t trackingId;
    NvMOTRect bbox;
    float confidence;
    uint32_t age;
    NvMOTObjToTrack *associatedObjectIn;
} NvMOTTrackedObj;
typedef enum { NvMOTStatus_OK, NvMOTStatus_Error } NvMOTStatus;

enum { MOST = 256 };
gt2_tracker *tracker_of(NvMOTStreamId stream);
NvMOTStatus fragment(const NvMOTFrame *frame, NvMOTTrackedObj *out, uint32_t *filled);

NvMOTStatus fragment(const NvMOTFrame *frame, NvMOTTrackedObj *out, uint32_t *filled) {
@BLOCK@
    return NvMOTStatus_OK;
}
