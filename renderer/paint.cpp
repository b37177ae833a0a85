#include "renderer/paint.h"
