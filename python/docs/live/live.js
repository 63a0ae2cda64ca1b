// The page: both parts, and the state that tests read.
import { boxes } from "./boxes.js";
import { field } from "./field.js";

window.live = { boxes: boxes(), field: field() };
