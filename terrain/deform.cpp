#include "terrain/deform.h"
