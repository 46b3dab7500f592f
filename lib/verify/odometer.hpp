#pragma once

#include "model/odometer.hpp"
