#include "renderer/sun.h"
