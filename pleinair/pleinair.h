#pragma once

/// The public face of the library: recordings and cameras, the tracker, the sun and the sky, the
/// pipeline that composes frames, and what writes images, films and camera paths.

#include "devices/calibration/calibration.h"
#include "devices/cameras/camera.h"
#include "devices/recordings/recording.h"
#include "export/images/image_writer.h"
#include "export/images/video_writer.h"
#include "export/trajectories/trajectory_files.h"
#include "scene/scene_description.h"
#include "scene/sun_over_place.h"
#include "session/pipeline.h"
#include "session/recording_passes.h"
#include "sky/daylight.h"
#include "sky/sky_model.h"
#include "sky/sun/sun_position.h"
#include "tracker/tracker.h"
