#include "terrain/dem.h"
