#include "terrain/derivatives.h"
