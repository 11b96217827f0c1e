/** Requests and part names in ten scripts, two of them written from right to left. tests/core/scripts.h has the same. */
export const scripts: readonly {
  readonly name: string;
  readonly request: string;
  readonly parts: readonly string[];
}[] = [
  { name: 'Latin with diacritics', request: 'élargir la table de moitié', parts: ['Füße', 'čalounění', 'mặt bàn'] },
  { name: 'Latin, decomposed', request: 'e\u0301largir', parts: ['Fu\u0308ße', 'pie\u0301d'] },
  { name: 'Greek', request: 'κάνε το τραπέζι πιο φαρδύ', parts: ['κάθισμα', 'πόδι'] },
  { name: 'Cyrillic', request: 'расширь стол', parts: ['сиденье', 'ножка'] },
  { name: 'Arabic', request: 'وسّع الطاولة', parts: ['مِقْعَد', 'ساق'] },
  { name: 'Persian', request: 'میز را پهن‌تر کن', parts: ['پایه‌ها', 'رویه'] },
  { name: 'Hebrew', request: 'הרחב את השולחן', parts: ['מוֹשָׁב', 'רגל'] },
  { name: 'Devanagari', request: 'मेज़ को चौड़ा करो', parts: ['सीट', 'पैर', 'क्‍षेत्र'] },
  { name: 'Thai', request: 'ขยายโต๊ะให้กว้างขึ้น', parts: ['ที่นั่ง', 'ขาเก้าอี้'] },
  { name: 'Chinese', request: '加宽桌面', parts: ['座椅', '椅腿'] },
  { name: 'Japanese', request: 'テーブルを広げて', parts: ['座面', 'ガラス板'] },
  { name: 'Korean', request: '탁자를 넓혀 줘', parts: ['좌석', '\u1103\u1161\u1105\u1175'] },
  { name: 'emoji', request: '🪑➡️ wider', parts: ['🪑', '👩🏽‍🔧', '🇩🇪🇫🇷', '❤️‍🔥'] },
];
