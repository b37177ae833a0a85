#include "terrain/heightfield.h"
