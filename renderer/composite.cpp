#include "renderer/composite.h"
