// All tests in one process, so that they share one browser.

import './axe.test.mjs';
import './compare.test.mjs';
import './figures.test.mjs';
import './file.test.mjs';
import './focus.test.mjs';
import './framed.test.mjs';
import './guard.test.mjs';
import './intro.test.mjs';
import './keyboard.test.mjs';
import './link.test.mjs';
import './malformed.test.mjs';
import './narrow.test.mjs';
import './opens.test.mjs';
import './playout.test.mjs';
import './return.test.mjs';
import './stop.test.mjs';
import './stories.test.mjs';
import './timeline.test.mjs';
import './viewers.test.mjs';
import './why.test.mjs';
import './words.test.mjs';
import './worker.test.mjs';
