#include "terrain/synthetic.h"
