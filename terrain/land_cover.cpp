#include "terrain/land_cover.h"
