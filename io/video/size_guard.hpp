// Refuses pictures that are too large before there is memory for them.
//
// A stream of a few kB can announce pictures of gigabytes. A decoder that asks on its source pad who has memory for
// such pictures is given a pool that has none, and the reason is the pipeline's error. What a decoder keeps for itself
// before it asks (a progressive JPEG as a whole) is not seen here: for that godwit-eyes has a bound for the process.
//
// Thread: that of the pipeline's owner; the check runs in GStreamer's threads.
// Source: GStreamer 1.22, gst_pad_add_probe, GST_QUERY_ALLOCATION, gst_video_decoder_allocate_output_frame.
#pragma once

#include <gst/gst.h>

namespace godwit::io::video {

// Cameras have up to 5,472 x 3,078. A picture of this area has 25 MB as I420, and a pipeline holds some ten.
inline constexpr int max_side_px = 8'192;
inline constexpr int max_area_px = 4'096 * 4'096;

// WHOLE: before it plays; its element named `convert` gets what all decoders and cameras give.
void guard_picture_sizes(GstElement* whole);

} // namespace godwit::io::video
