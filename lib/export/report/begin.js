"use strict";

(() => {
