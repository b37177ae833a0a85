#include "renderer/palette.h"
