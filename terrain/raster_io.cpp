#include "terrain/raster_io.h"
