#include "terrain/hydrology.h"
