#include "texture/synthesize.h"
