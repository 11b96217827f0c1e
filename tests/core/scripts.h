// Requests and part names in ten scripts, two of them written from right to left. tests/web/scripts.ts has the same.
#pragma once

#include <string>
#include <vector>

namespace parsel {

struct Script {
  const char* name;
  std::string request;
  std::vector<std::string> parts;
};

inline const std::vector<Script> scripts = {
    {"Latin with diacritics", "élargir la table de moitié", {"Füße", "čalounění", "mặt bàn"}},
    {"Latin, decomposed", "e\u0301largir", {"Fu\u0308ße", "pie\u0301d"}},
    {"Greek", "κάνε το τραπέζι πιο φαρδύ", {"κάθισμα", "πόδι"}},
    {"Cyrillic", "расширь стол", {"сиденье", "ножка"}},
    {"Arabic", "وسّع الطاولة", {"مِقْعَد", "ساق"}},
    {"Persian", "میز را پهن\u200cتر کن", {"پایه\u200cها", "رویه"}},
    {"Hebrew", "הרחב את השולחן", {"מוֹשָׁב", "רגל"}},
    {"Devanagari", "मेज़ को चौड़ा करो", {"सीट", "पैर", "क्\u200dषेत्र"}},
    {"Thai", "ขยายโต๊ะให้กว้างขึ้น", {"ที่นั่ง", "ขาเก้าอี้"}},
    {"Chinese", "加宽桌面", {"座椅", "椅腿"}},
    {"Japanese", "テーブルを広げて", {"座面", "ガラス板"}},
    {"Korean", "탁자를 넓혀 줘", {"좌석", "\u1103\u1161\u1105\u1175"}},
    {"emoji", "🪑➡️ wider", {"🪑", "👩🏽\u200d🔧", "🇩🇪🇫🇷", "❤️\u200d🔥"}},
};

}  // namespace parsel
